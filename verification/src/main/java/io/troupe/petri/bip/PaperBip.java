package io.troupe.petri.bip;

import java.util.List;
import java.util.function.Predicate;

/**
 * The paper's two robots and their arbitrator as BIP models. The paper shows such a model in Figure 13, whose picture
 * is not available to us: components and interactions are those of the text of its section 3.3 and Table 4.
 *
 * <p>Each robot has a wall follower and a space wanderer. In state 1 robot 1 follows walls and robot 2 wanders, in
 * state 2 the other way round, in state 3 both wander. A wanderer that sees the colour of another state makes the
 * arbitrator leave the present one: it stops both services and starts those of the next state.
 *
 * <p><b>Source.</b> The paper, section 3.3, rules [1] to [4], Tables 3 and 4, Figure 13.
 */
public final class PaperBip {
    private static final int STATES = 3;
    /** The service of each robot in each state: {@code follower} or {@code wanderer}. */
    private static final List<List<String>> TABLE =
            List.of(List.of("follower", "wanderer"), List.of("wanderer", "follower"), List.of("wanderer", "wanderer"));

    private PaperBip() {}

    /** The arbitrator waits until both services have stopped before it starts the next ones. */
    public static BipModel waiting() {
        return switching("two_robots", true);
    }

    /** The arbitrator starts the next services at once, as in the paper's Figure 20. */
    public static BipModel notWaiting() {
        return switching("two_robots_not_waiting", false);
    }

    /** A state in which a robot, 1 or 2, has two services that are not off. */
    public static Predicate<BipStates.State> twoServices(int robot) {
        return state -> !state.isIn("follower" + robot, "off") && !state.isIn("wanderer" + robot, "off");
    }

    /**
     * The rules [1] to [4] as they are written, as priorities of services: all services run all the time, and in each
     * state the service of the table goes before the other one of the same robot.
     */
    public static BipModel rulesAsPriorities() {
        var follower = AtomType.starting("AlwaysFollower", "run").on("cycle", "run", "run");
        var wanderer = AtomType.starting("AlwaysWanderer", "run")
                .on("cycle", "run", "run")
                .on("colour", "run", "run");
        var arbitrator = AtomType.starting("Rules", "state1");
        for (var state = 1; state <= STATES; state++) {
            arbitrator = arbitrator.on("in" + state, "state" + state, "state" + state);
        }
        for (var from = 1; from <= STATES; from++) {
            for (var to = 1; to <= STATES; to++) {
                if (from != to) {
                    arbitrator = arbitrator.on("see" + from + to, "state" + from, "state" + to);
                }
            }
        }
        var model = robots(BipModel.named("two_robots_by_priorities"), arbitrator, follower, wanderer);
        for (var from = 1; from <= STATES; from++) {
            for (var robot = 1; robot <= 2; robot++) {
                var drive = "drive" + from + "_";
                for (var service : List.of("follower", "wanderer")) {
                    var each = service + robot;
                    model.connector(drive + each, "arbitrator.in" + from, each + ".cycle", "robot" + robot + ".drive");
                }
                var first = service(from, robot);
                var other = first.equals("follower") ? "wanderer" : "follower";
                model.priority(drive + other + robot, drive + first + robot);
            }
            for (var to = 1; to <= STATES; to++) {
                for (var robot = 1; robot <= 2; robot++) {
                    if (from != to && service(from, robot).equals("wanderer")) {
                        var see = "see" + from + to;
                        model.connector(see + "_by" + robot, "arbitrator." + see, "wanderer" + robot + ".colour");
                    }
                }
            }
        }
        return model.build();
    }

    private static BipModel switching(String name, boolean waits) {
        var follower = service("Follower");
        var wanderer = service("Wanderer").on("colour", "run", "run");
        var model = robots(BipModel.named(name), arbitrator(waits), follower, wanderer);
        for (var state = 1; state <= STATES; state++) {
            var first = service(state, 1) + 1;
            var second = service(state, 2) + 2;
            for (var change : List.of("start", "stop")) {
                model.connector(
                        change + state, "arbitrator." + change + state, first + "." + change, second + "." + change);
            }
            if (waits) {
                model.connector(
                        "stopped" + state, "arbitrator.stopped" + state, first + ".stopped", second + ".stopped");
            }
        }
        for (var robot = 1; robot <= 2; robot++) {
            for (var state = 1; state <= STATES; state++) {
                model.connector(
                        "see" + state + "_by" + robot, "arbitrator.see" + state, "wanderer" + robot + ".colour");
            }
            for (var service : List.of("follower", "wanderer")) {
                var each = service + robot;
                model.connector("drive_" + each, each + ".cycle", "robot" + robot + ".drive");
                if (!waits) {
                    model.connector("stopped_" + each, each + ".stopped");
                }
            }
        }
        return model.build();
    }

    private static String service(int state, int robot) {
        return TABLE.get(state - 1).get(robot - 1);
    }

    private static BipModel.Builder robots(
            BipModel.Builder model, AtomType arbitrator, AtomType follower, AtomType wanderer) {
        var robot = AtomType.starting("Robot", "ready").on("drive", "ready", "ready");
        model.component("arbitrator", arbitrator);
        for (var number = 1; number <= 2; number++) {
            model.component("follower" + number, follower)
                    .component("wanderer" + number, wanderer)
                    .component("robot" + number, robot);
        }
        return model;
    }

    /** A service drives while it runs, and needs time to stop. */
    private static AtomType service(String name) {
        return AtomType.starting(name, "off")
                .on("start", "off", "run")
                .on("cycle", "run", "run")
                .on("stop", "run", "stopping")
                .on("stopped", "stopping", "off");
    }

    private static AtomType arbitrator(boolean waits) {
        var arbitrator = AtomType.starting("Arbitrator", "go1");
        for (var state = 1; state <= STATES; state++) {
            arbitrator = arbitrator.on("start" + state, "go" + state, "state" + state);
        }
        for (var from = 1; from <= STATES; from++) {
            for (var to = 1; to <= STATES; to++) {
                if (from != to) {
                    var leaving = "leave" + from + "to" + to;
                    var waiting = "wait" + from + "to" + to;
                    arbitrator = arbitrator
                            .on("see" + to, "state" + from, leaving)
                            .on("stop" + from, leaving, waits ? waiting : "go" + to);
                    if (waits) {
                        arbitrator = arbitrator.on("stopped" + from, waiting, "go" + to);
                    }
                }
            }
        }
        return arbitrator;
    }
}
