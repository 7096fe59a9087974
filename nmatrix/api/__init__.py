"""The Python face: functions on arrays, setups whose methods are the commands, reports."""
