"""Test that pictures of a question are drawn once, and only when they are read."""

from asked import PICTURE

from anymesh.prompted.answerers.vlm_answerer import request_of
from anymesh.prompted.questions.recognition import ask_recognition
from anymesh.types.exchange import DrawnPictures
from anymesh.types.motion import Recognition


def test_pictures_are_drawn_once_when_they_are_first_read() -> None:
    drawn = []
    pictures = DrawnPictures(lambda: drawn.append(1) or (PICTURE, PICTURE))  # ty: ignore[invalid-argument-type]
    assert drawn == []
    assert (len(pictures), pictures[0], pictures[1:], tuple(pictures)) == (2, PICTURE, (PICTURE,), (PICTURE, PICTURE))
    assert drawn == [1]


def test_an_answerer_that_does_not_read_pictures_has_none_drawn() -> None:
    asked, drawn = [], []

    class Reference:
        name, exchanges, warnings = "reference", (), ()

        def ask(self, question):
            asked.append(question)
            return Recognition("box", 1.0, (), None)

    ask_recognition(lambda: drawn.append(1) or (PICTURE,), Reference(), None, (), [0.0])  # ty: ignore[invalid-argument-type]
    assert drawn == []
    assert request_of(asked[0]).pictures == (PICTURE,)
