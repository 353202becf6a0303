// scripts/bundle writes the studio here.
