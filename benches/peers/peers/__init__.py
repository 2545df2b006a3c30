"""The comparison of gaitc with other codes on three units of work; `run.py` is where it starts."""
