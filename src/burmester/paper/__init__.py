"""The paper's numbers, figures and methods beside ours."""
