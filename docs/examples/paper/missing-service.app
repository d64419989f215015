# A robot needs a service that no component offers: the application ends, and says what is missing.
application missing-service

component robots   is player port=${port} robots=1,2
component follower is wallFollower

missing-service needs service player
robot1          needs service wallFollower
robot2          needs capability wanders
