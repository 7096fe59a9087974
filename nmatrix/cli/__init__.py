"""The thin shell: arguments in, one report out, one line when something is wrong."""
