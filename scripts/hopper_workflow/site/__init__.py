"""The site: pages taken from what the project says elsewhere, and Sphinx run over them.

Nothing is written twice. README, docs, schema, parsers, glossary, captions and docstrings are the
sources; docs/site holds what stands nowhere else. ``python -m hopper_workflow.site`` builds it.
"""
