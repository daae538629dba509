"""This program runs xacro on a file that is not trusted: SECONDS FILE PACKAGES PATH...; it is no part of the command.

Xacro evaluates expressions of Python, and its own filter can be passed by. So it gets a process without environment and
without the library, and from the moment it starts no event of Python's passes that is not named here: files are read
below the file's folder and PACKAGES alone, and there is no file to write, no socket, no process, no import.
"""

import os
import resource
import sys

MEMORY = 2 << 30
HARMLESS = {"compile", "exec", "glob.glob", "glob.glob/2", "object.__getattr__", "sys._getframe", "builtins.id"}


def main(seconds: str, file: str, packages: str, *path: str) -> None:
    """Print what xacro makes of the file; exit code 1 and the reason, on the last line, where it makes nothing."""
    sys.path[:] = path
    import xml.dom.expatbuilder  # noqa: F401  (nothing can be imported later)

    import xacro
    import xacro.substitution_args as substitution

    folders = [os.path.realpath(one) for one in (os.path.dirname(file) or ".", packages) if one]

    def watch(event: str, given: tuple) -> None:
        if event in ("open", "os.scandir", "os.listdir") and isinstance(given[0], (str, bytes)):
            place = os.path.realpath(os.fsdecode(given[0]))
            if not any(os.path.commonpath([place, folder]) == folder for folder in folders):
                raise RuntimeError(f"{place} is outside the file's folder; --packages DIR opens one more")
            if event == "open" and given[2] & (os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC):
                raise RuntimeError(f"{place} would be written")
        elif event not in HARMLESS:
            raise RuntimeError(f"an expression asks for {event}")

    if packages:
        substitution._eval_find = lambda name: os.path.join(packages, name)
    for what, most in ((resource.RLIMIT_CPU, int(seconds)), (resource.RLIMIT_AS, MEMORY), (resource.RLIMIT_FSIZE, 0)):
        resource.setrlimit(what, (most, most))
    sys.addaudithook(watch)
    text = b""
    try:
        text = xacro.process_file(file).toxml().encode()
    except BaseException as error:  # whatever a foreign expression raises
        said = " ".join(f"{type(error).__name__}: {error}".split())[:400]
        sys.stderr.write("\n" + said.encode("ascii", "backslashreplace").decode())
        sys.stderr.flush()
    sys.stdout.buffer.write(text)
    sys.stdout.flush()
    os._exit(not text)  # nothing foreign runs again


if __name__ == "__main__":
    main(*sys.argv[1:])
