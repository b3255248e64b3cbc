"""Run a lab's cells in its own page: the page is the kernel.

    session = Session()
    for k in needs(sources, i, session.names()):
        session.run(sources[k], k)
    outputs = session.run(source, i)["outputs"]

The page runs this package in Pyodide, which has NumPy and robokin but no Matplotlib, no IPython
and no threads. Everything here also works in an ordinary Python.

Time limits. Python cannot interrupt an answer without threads, so the page does it. It replaces
the two functions of this module:

    began(limit, sentence)  a student's answer begins to run; if `ended` is not called within
                            `limit` seconds, end Python and show `sentence` as the verdict
    ended()                 the answer has ended

Views that ask a kernel. A view in an output of `Session.run` has the attribute `data-player`, its
id. The page sends its questions to `Session.ask(id, question)`; the answer is for `joinArrays` in
js/live.js.
"""

from collections.abc import Callable

began: Callable[[float, str], None] = lambda limit, sentence: None  # noqa: E731
ended: Callable[[], None] = lambda: None  # noqa: E731
