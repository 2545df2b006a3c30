"""gaitc's optimizer beside general solvers; see README.md."""
