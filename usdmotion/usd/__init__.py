"""The only reader and writer of USD.

Importing it makes USD know the schema and those of plugins, so do it before opening a stage.
"""

from usdmotion.plugins import host
from usdmotion.usd.registration import RegistrationError, register

try:
    register(host().schemas)
except RegistrationError:  # a plugin that brings a broken schema takes nobody down with it
    register()

from usdmotion.usd.authoring import author, author_edit
from usdmotion.usd.captures import write_capture
from usdmotion.usd.character_authoring import author_body, author_character
from usdmotion.usd.detections import (
    Found,
    author_detections,
    author_feet,
    author_template,
    detection_provenance,
    read_searches,
)
from usdmotion.usd.drafts import Draft, drawn_on
from usdmotion.usd.edit_layers import files_of, read_outcomes
from usdmotion.usd.edits import unsolved_edits
from usdmotion.usd.guides import (
    author_contact_guides,
    author_contact_marks,
    author_guides,
    read_contact_marks,
)
from usdmotion.usd.inspected import Inspection
from usdmotion.usd.inspection import inspect, inspect_stage
from usdmotion.usd.new_stages import new_stage
from usdmotion.usd.normalized import author_normalized, read_normalized, write_normalized
from usdmotion.usd.outcomes import outcomes_of, solved_edits
from usdmotion.usd.outputs import require_apart, require_unread
from usdmotion.usd.overlays import Overlay
from usdmotion.usd.planting import author_keeping, author_passes, edits_of
from usdmotion.usd.prop_authoring import author_mesh, author_prop
from usdmotion.usd.reaches import author_reach
from usdmotion.usd.reading import read, read_stage
from usdmotion.usd.recordings import write_recording
from usdmotion.usd.region_authoring import author_region
from usdmotion.usd.shot import Result, Shot
from usdmotion.usd.shown_results import author_shown, is_shown
from usdmotion.usd.stages import Stage, name_of, require_composed
from usdmotion.usd.variants import variant
from usdmotion.usd.varying import vary
from usdmotion.usd.writing import Draw, compose, put, require_composable, write

__all__ = [
    "Draft",
    "Draw",
    "Found",
    "Inspection",
    "Overlay",
    "Result",
    "Shot",
    "Stage",
    "author",
    "author_body",
    "author_character",
    "author_contact_guides",
    "author_contact_marks",
    "author_detections",
    "author_edit",
    "author_feet",
    "author_guides",
    "author_keeping",
    "author_mesh",
    "author_normalized",
    "author_passes",
    "author_prop",
    "author_reach",
    "author_region",
    "author_shown",
    "author_template",
    "compose",
    "detection_provenance",
    "drawn_on",
    "edits_of",
    "files_of",
    "inspect",
    "inspect_stage",
    "is_shown",
    "name_of",
    "new_stage",
    "outcomes_of",
    "put",
    "read",
    "read_contact_marks",
    "read_normalized",
    "read_outcomes",
    "read_searches",
    "read_stage",
    "require_apart",
    "require_composable",
    "require_composed",
    "require_unread",
    "solved_edits",
    "unsolved_edits",
    "variant",
    "vary",
    "write",
    "write_capture",
    "write_normalized",
    "write_recording",
]
