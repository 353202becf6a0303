"""Files in and out: poses (`burmester.io.poses`) and the cases carried along (`.cases`).

Nothing is imported here, so that asking for the names of the cases stays cheap.
"""
