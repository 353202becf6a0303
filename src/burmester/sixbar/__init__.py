"""Six-bars: the linkages that are left where no four-bar works."""
