"""Study files: what the robot is, what it has to do, and what counts as good enough."""

from actuator_select.study.loading import (
    Study,
    Variant,
    builtin_studies,
    load_study,
    parse_study,
    starter_text,
    study_text,
)
from actuator_select.study.overrides import parse_overrides

__all__ = [
    "Study",
    "Variant",
    "builtin_studies",
    "load_study",
    "parse_overrides",
    "parse_study",
    "starter_text",
    "study_text",
]
