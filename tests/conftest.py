"""Hypothesis without a clock, and the same examples every time.

`pytest --hypothesis-profile=search` looks for new ones.
"""

from hypothesis import settings

settings.register_profile("search", deadline=None, print_blob=True, max_examples=300)
settings.register_profile("house", deadline=None, derandomize=True)
settings.load_profile("house")
