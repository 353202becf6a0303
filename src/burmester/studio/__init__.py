"""The studio: one page on this machine in which a linkage is designed by hand and eye, live.

`serve` opens it.  This process answers the page and imports no NumPy; `worker` is a process of its
own that does all science, so that nothing that takes long holds up the page, and what takes too
long can be killed.
"""
