# The paper's two robots, each a user of one of the paper's two services.
#
#   ./troupe app demo/applications/two-robots.app
#
# The broker finds each service by its name or by what it can do, starts it because somebody needs it, and connects
# what has the same name: robot1/sonar goes to the provider's sonar, the provider's velocity comes back to robot1.

application two-robots

component robots   is player port=${port} robots=1,2
component follower is wallFollower
component wanderer is spaceWanderer
component finder   is colourFinder
component relief   is spaceWanderer        # takes over from the follower, and is started only then

two-robots needs service player
robot1     needs service wallFollower
robot2     needs capability wanders
robot2     needs service colourFinder

at 30s replace follower by relief
