"""Answers that go with a task while a hand changes it on a page: the studio, or a notebook."""
