"""What a camera sees of a stage at some times: surfaces, skinned by UsdSkel, and the camera."""
