"""The subcommands of `fingerpad`, a module each: its description, what it takes (`add`) and what it does (`run`)."""
