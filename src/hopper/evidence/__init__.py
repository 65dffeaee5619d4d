"""What only the claims ledger needs: equations and formulas to hold the paper's statements against.

The equations of motion as tensors, formulas as printed, characteristics from the symbol, the
operator of smooth-wall theory, and the first-derivative operator.
"""
