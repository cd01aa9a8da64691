"""The plugin of usdview: a menu of what usdmotion does, on the stage that is open.

usdview finds it by the plugInfo.json beside this file and imports `container`, which does nothing
but define: `menu` says what there is, `running` carries a command out when somebody picks it.
Everything else is imported then.
"""
