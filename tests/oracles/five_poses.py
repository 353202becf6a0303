"""Five poses with four real dyads, as published (motiongen-shoulder): x, y, angle in degrees."""

ROWS = [
    (-3.9696, -2.6338, 37.23),
    (-0.2223, -0.3211, 27.48),
    (3.3279, 3.9568, 8.17),
    (7.7225, 10.0149, -14.86),
    (5.7615, 18.8535, -25.64),
]
