import sys


def generate_launch_description():
    sys.exit('no map given')
