"""The plugin of usdview: a menu of what usdmotion does, on the stage that is open."""
