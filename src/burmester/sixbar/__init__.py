"""Six-bars of Watt's first kind: the linkages that are left where no four-bar works."""
