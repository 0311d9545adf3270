"""Named errors: one class for each way in which a user or a computation can fail."""


class FingerpadError(Exception):
    """Base of every error that fingerpad raises on purpose."""


class UsageError(FingerpadError):
    """A command or a function was asked for something that it cannot do."""


class SceneError(FingerpadError):
    """A scene file or a scene is not valid; the message names file, key, found and allowed."""


class RatingError(FingerpadError):
    """A table of ratings does not fit the devices it rates."""


class UnsolvedError(FingerpadError):
    """A scene is valid, but has no solution that can be vouched for."""


class MeshError(UnsolvedError):
    """The section cannot be meshed, or a mesh came out inverted."""


class CondensationError(UnsolvedError):
    """A stiffness is singular, or a condensed map misses the accuracy that it must have."""


class ContactError(UnsolvedError):
    """A pressed finger cannot be followed: contact, tissue or vibration has no solution that can be vouched for."""


class CalculixError(FingerpadError):
    """CalculiX failed on a deck, took too long, or printed something else than was asked for."""


class ConvergenceError(ContactError):
    """An increment of contact did not converge, however small."""


class UniquenessError(ContactError):
    """The laws of contact lost their unique solution: friction is too large, or skin hangs on a wall."""


class InvertedError(ContactError):
    """Tissue is turned inside out: an element would be pressed to nothing."""


class SnapError(ContactError):
    """Tissue has no stable state nearby: it would snap to one far away, or two ways branch off."""


class EllipticityError(ContactError):
    """The tissue's law softens so much that strain gathers in bands as thin as the mesh: no answer is the law's own."""


class CrossingError(ContactError):
    """The deformed skin crosses itself: it would touch itself, which contact does not know."""


class CriterionError(ContactError):
    """Pre-indentation does not reach its criterion. touched: whether all actuators touched skin at once on the way."""

    def __init__(self, message: str, touched: bool = True) -> None:
        super().__init__(message)
        self.touched = touched


class DepthError(ContactError):
    """An actuator would be pressed deeper than the tissue is thick."""


class CertificateError(ContactError):
    """A solution disobeys the laws it was solved for."""


class CycleError(ContactError):
    """Vibration did not come to a cycle that repeats itself."""


class InertiaError(ContactError):
    """The tissue's mass matters at a frequency, and the model has none."""


class ReachError(ContactError):
    """Contact reaches beyond the skin that was considered, or skin touches two actuators at once."""


class ProcessError(FingerpadError):
    """One of several processes that solve side by side was ended from outside."""


class ResultError(FingerpadError):
    """A file of results holds something else than fingerpad writes there."""


class MissingResultError(FingerpadError):
    """A result that is to be looked at has not been computed; the message names the target that makes it."""
