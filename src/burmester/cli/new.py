"""`burmester new`: a task file to start from."""

from __future__ import annotations

import click

from burmester.cli.output import EXIT_FOUND, show_list


@click.command()
@click.argument("template", required=False)
@click.option(
    "-o", "--output", metavar="FILE", help='Name of the file, or "-" for standard output.'
)
@click.option("--force", is_flag=True, help="Replace the file if it exists.")
@click.option("--list", "as_list", is_flag=True, help="List the templates.")
@click.option(
    "--schema", is_flag=True, help="Print the JSON schema of task files, by which editors help."
)
def new(template: str | None, output: str | None, force: bool, as_list: bool, schema: bool) -> int:
    """Write a task file to start from, with comments.

    TEMPLATE is one of those that --list shows; by default a file with every key.
    """
    from burmester.io import templates

    if schema:
        import json

        from burmester.io.task_schema import task_schema

        click.echo(json.dumps(task_schema(), indent=1, ensure_ascii=False))
        return EXIT_FOUND

    if as_list:
        show_list([(each, templates.summary(each)) for each in templates.names()])
        return EXIT_FOUND
    name = template or templates.BLANK
    text = templates.text(name)
    if output == "-":
        click.echo(text, nl=False)
        return EXIT_FOUND
    from burmester.io.files import quoted, write
    from burmester.printable import printable

    path = output or f"{name}.toml"
    write(path, text, force=force)
    click.echo(f"wrote {printable(path)}: {templates.summary(name)}")
    command = "function" if "[function]" in text else "synthesize"
    click.echo(f"next: burmester {command} {quoted(path)}")
    return EXIT_FOUND
