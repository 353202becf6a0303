"""JSON and TOML: poses, body, limits and requirements as trees."""
