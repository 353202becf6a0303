"""What commands print and write, kept as fingerprints: a change of the inside changes none."""

import os

# As `scripts/test` has them: linear algebra rounds alike on all machines.
for name, value in (
    ("OMP_NUM_THREADS", "1"),
    ("OPENBLAS_NUM_THREADS", "1"),
    ("OPENBLAS_CORETYPE", "Haswell"),
    ("NPY_DISABLE_CPU_FEATURES", "X86_V4 AVX512_ICL AVX512_SPR"),
):
    os.environ.setdefault(name, value)
