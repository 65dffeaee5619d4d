"""The claims of the paper, judged by artifacts: comparisons only, no mathematics.

The words of each claim stand in resources/claims.yaml; a function of the same name, in the module
of its section, judges it.
"""
