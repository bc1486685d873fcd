"""Event: something that happens while the launch runs."""



class Event:
    name = 'launch.Event'
