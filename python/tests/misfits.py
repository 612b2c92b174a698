"""What no text, path or number is, as hasty scripts pass it on."""
import numpy as np

WRONG_TEXTS = (3, 2.5, None, True, b"x", ["x"], {"a": 1}, object(), np.array(["x", "y"]), 1j, 10**400, "a\0b", "\ud800")
WRONG_PATHS = (*WRONG_TEXTS, "")
WRONG_NUMBERS = (None, True, "1", b"1", [1.0], {}, object(), np.array([1.0, 2.0]), 1 + 0j, np.complex128(1), 10**400)
