"""Mutants of the kernel: each is built, which takes minutes."""

from __future__ import annotations

from tests.mutation.subject import Mutant, Subject

_CHECKPOINT = "cpp/hydrodae/run/checkpoint.cpp"
_EXCITATION = "cpp/hydrodae/water/excitation.cpp"
_WEIGHTS = "b.pose.data(),\n                              b.pose_slopes.data());\n}"
_SEA = "cpp/hydrodae/sea/pierson_moskowitz.h"

SUBJECT = Subject(
    "kernel",
    (
        *("tests/python/test_checkpoint.py", "tests/verification/test_pose_tables.py"),
        *("tests/python/test_input_files.py", "tests/python/test_simulation.py"),
    ),
    (
        Mutant(
            _CHECKPOINT, '"input_files", model::text_of_files(scene.files)', '"input_files", ""'
        ),
        Mutant(_CHECKPOINT, '"case_text", scene.text', '"case_text", ""'),
        Mutant(_CHECKPOINT, '"version", HYDRODAE_VERSION', '"version", ""'),
        Mutant(
            _EXCITATION,
            _WEIGHTS,
            _WEIGHTS.replace("\n}", "\n  for (S& weight : b.pose)\n    weight *= S(1.2);\n}"),
        ),
    ),
    compiled=True,
)
