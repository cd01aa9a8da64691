"""The detector: what it finds, and that it does not matter where, when and in which order."""

import numpy as np
import pytest
from usdmotion_contacts import ContactDetector

from usdmotion import OptionError, configured
from usdmotion.testing import check_detector


@pytest.mark.parametrize("options", [{}, {"clock": 0.5}, {"reach": 0.0}])
def test_it_keeps_the_contract_of_detectors(options) -> None:
    check_detector(configured(ContactDetector, options))


def test_two_rests_are_two_contacts_at_their_places(detect, two_stances) -> None:
    first, second = detect(two_stances()).contacts
    assert (first.kind, first.start, second.kind) == ("space", 0.0, "space")
    assert first.end == pytest.approx(1.0, abs=0.02)
    assert second.start == pytest.approx(1.4, abs=0.02)
    assert np.allclose(first.location, 0.0, atol=1e-6)
    assert np.allclose(second.location, (0.6, 0.0, 0.0), atol=1e-6)


def test_noise_of_the_size_of_the_templates_cuts_nothing(detect, two_stances) -> None:
    assert len(detect(two_stances(noise=3e-4)).contacts) == 2


def test_a_kind_that_nobody_knows_is_refused_with_those_that_are(detect, two_stances) -> None:
    with pytest.raises(OptionError, match="'cone'; it looks for space, line, point, plane, slide"):
        detect(two_stances(kinds=("space", "cone")))


@pytest.mark.parametrize("noise", [0.01, 0.02])
def test_one_place_is_one_contact_under_noise_as_large_as_what_may_lie_between(
    detect, two_stances, noise
) -> None:
    search = two_stances(noise=noise)
    first, second = detect(search).contacts
    assert first.end - first.start > 0.9
    assert np.allclose(first.location, 0.0, atol=0.5 * noise)
    assert np.allclose(second.location, (0.6, 0.0, 0.0), atol=0.5 * noise)
