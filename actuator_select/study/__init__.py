"""Study files: what the robot is, what it has to do, and what counts as good enough."""

from actuator_select.study.loading import (
    Study,
    Variant,
    builtin_studies,
    load_study,
    parse_study,
    study_text,
)
from actuator_select.study.overrides import parse_overrides
from actuator_select.study.sweeping import SweepAxis
from actuator_select.study.template_families import TEMPLATES, TemplateOptions
from actuator_select.study.templates import DEFAULT_TEMPLATE, template_text

__all__ = [
    "DEFAULT_TEMPLATE",
    "TEMPLATES",
    "Study",
    "SweepAxis",
    "TemplateOptions",
    "Variant",
    "builtin_studies",
    "load_study",
    "parse_overrides",
    "parse_study",
    "study_text",
    "template_text",
]
