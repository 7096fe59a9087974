"""A session: names, settings, statements, help, and what TAB offers."""
