"""The application that every verb is a command of."""

import typer

app = typer.Typer(
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    add_completion=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="Make captured motion fit the shot, in USD, without touching the original.",
)
schema = typer.Typer(no_args_is_help=True, help="Make USD know the schema.")
app.add_typer(schema, name="schema")
