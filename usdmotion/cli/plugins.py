"""Plugins: what is installed is shown."""

from usdmotion.cli.application import app
from usdmotion.cli.flags import Json, Quiet
from usdmotion.terminal import Terminal, tables, to_json, write_text


@app.command(epilog="Example: usdmotion plugins --json plugins.json")
def plugins(json: Json = None, quiet: Quiet = False) -> None:
    """Show what is installed, and what was set aside and why."""
    from usdmotion.catalogue import Catalogue
    from usdmotion.plugins import host

    terminal = Terminal.open(quiet=quiet, json=json)
    catalogue = Catalogue.of(host())
    if json is not None:
        write_text(to_json(catalogue), json)
    terminal.tell(*tables(catalogue))
