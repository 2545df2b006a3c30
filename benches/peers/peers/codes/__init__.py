"""One module a code. Each has `VERSIONS` (packages to name in the table) and `attempts(unit)`."""
