# Robot 1 is driven by a service in Java over the bus, robot 2 by a component in Python, which joins over TCP by the Player protocol.
#
#   ./troupe app demo/applications/python.app

application two-languages

component robots   is player port=${port} robots=1
component follower is wallFollower
component snake    is process run="python3 python/wanderer.py 127.0.0.1 ${tcp} 1" service=pythonWanderer capabilities=wanders

two-languages needs service player
robot1        needs service wallFollower
two-languages needs service pythonWanderer
