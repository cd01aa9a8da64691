"""What several tests of reading need."""

import pytest


@pytest.fixture
def first(text, save, read):
    """Return a function that reads the first constraint of a man with some edit."""

    def run(inside, body="", **options):
        path = save(text.man(edit=text.edit(inside), **options) + body, header=text.CENTIMETRES)
        (scene,) = read(path).scenes
        return scene.constraints[0]

    return run
