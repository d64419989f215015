# The paper's two robots, whose services run on two hosts; the world runs on a third, or on one of them.
#
#   ./troupe serve --world demo/worlds/paper-arena.cfg --bind ADDRESS
#   ./troupe app demo/applications/two-hosts.app --bus nats://HOST:4222 --robots HOST:6665 --name laptop
#   ./troupe app demo/applications/two-hosts.app --bus nats://HOST:4222 --robots HOST:6665 --name base
#
# The first node, base, runs the application. If the laptop is lost, the broker connects the robots with the reserves.
# Without --bus all of it runs in one process.

application two-hosts on base,laptop

component robots   is player host=${host} port=${port} robots=1,2
component follower is wallFollower   on laptop
component wanderer is spaceWanderer  on laptop
component reserve1 is wallFollower
component reserve2 is spaceWanderer

two-hosts needs service player
robot1    needs service wallFollower
robot2    needs service spaceWanderer
