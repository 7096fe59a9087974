"""The answers of the commands: a scene in, a report out."""
