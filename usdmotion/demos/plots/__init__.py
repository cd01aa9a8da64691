"""Figures of the papers that are curves, drawn from stages of our own, in the style of reports."""
