"""Schema: USD is made to know ours."""

import typer

from usdmotion.cli.application import schema
from usdmotion.terminal import Terminal, table


@schema.command("path", epilog="Example: usdmotion schema path")
def schema_path() -> None:
    """Print the folder of the schema; needs no USD."""
    import usdmotion_schemas

    print(usdmotion_schemas.plugin_path())


@schema.command("env", epilog="Example: usdmotion schema env")
def schema_env() -> None:
    """Print the environment in which any USD process knows the schema; needs no USD."""
    import usdmotion_schemas

    from usdmotion.plugins import host

    for line in usdmotion_schemas.environment(host().schemas):
        print(line)


@schema.command("check", epilog="Example: usdmotion schema check")
def schema_check() -> None:
    """Tell whether this USD knows the schema, and usdview the menu; status 2 where not."""
    from usdmotion.plugins import host
    from usdmotion.usd import registration

    findings = registration.check(host().schemas)
    Terminal.open().tell(table("schema", findings))
    if not all(finding.ok for finding in findings):
        raise typer.Exit(2)
