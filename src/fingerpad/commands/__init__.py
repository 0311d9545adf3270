"""The subcommands of `fingerpad`, a module each: what it takes (`add`) and what it does."""
