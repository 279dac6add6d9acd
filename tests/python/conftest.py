import os
import signal

os.environ.setdefault("MPLBACKEND", "Agg")  # no display
# A shell that starts something in the background makes it deaf to Ctrl-C; some tests press it.
signal.signal(signal.SIGINT, signal.default_int_handler)
