"""One module a code: `VERSIONS`, the packages it needs, and `configurations(task)`, the ways to use it, each a `Configuration`."""
