"""What pictures are drawn with: bodies, surfaces and marks, seen from somewhere, by matplotlib.

Draw inside `drawing()`, which gives a picture its style.
"""

from usdmotion.drawing.pictures import strip_picture
from usdmotion.drawing.style import Picture, drawing, require_matplotlib

__all__ = ["Picture", "drawing", "require_matplotlib", "strip_picture"]
