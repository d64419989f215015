package io.troupe.demo.monitor;

import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.rejects;
import static io.troupe.petri.wiring.Protocol.requests;

import io.troupe.petri.wiring.Branch;
import io.troupe.petri.wiring.Protocol;
import io.troupe.petri.wiring.ProtocolBuilder;
import io.troupe.petri.wiring.Wiring;
import io.troupe.services.subsumption.Mode;
import java.util.function.IntFunction;

/**
 * The main job as declarations, message by message, in each of the three modes: they are proved, and a run is compared
 * with them.
 *
 * <p>A call that its caller does not wait for is a component: the starter and the stopper of a robot are the messages
 * with which the arbitrator starts and stops its service, and the promise is that of its colour. The inbox judges each
 * colour, and drops those that come too late. At each tick the world finds all of them at rest; ADR 0003 defines when
 * an actor space has answered a reading. In callback mode all colours of one reading are one message, and the promise
 * is the way of these messages.
 *
 * <p>A service that has ended looks like one that waits for readings: a request to stop it is answered at once. Closing
 * a run is not part of the declarations.
 *
 * <p>With failures a service may fail at any time, also while it stops. In one process this ends the run: the world
 * asks it no more, and the others wait. Before that, they may go on with the reading.
 */
public final class RunWiring {
    private static final String OVER = "over";

    private final Mode mode;
    private final int robots;
    private final boolean mayFail;
    /** Whether a service calls the arbitrator and waits, in place of a promise. */
    private final boolean isDirect;

    private RunWiring(Mode mode, int robots, boolean mayFail, boolean isDirect) {
        this.mode = mode;
        this.robots = robots;
        this.mayFail = mayFail;
        this.isDirect = isDirect;
    }

    /** Without failures. */
    public static Wiring of(Mode mode, int robots) {
        return new RunWiring(mode, robots, false, false).wiring();
    }

    static Wiring withFailures(Mode mode, int robots) {
        return new RunWiring(mode, robots, true, false).wiring();
    }

    /** A wiring to avoid: a service calls the arbitrator, and waits until it accepts the colour. */
    public static Wiring withDirectCalls(int robots) {
        return new RunWiring(Mode.PROMISE, robots, false, true).wiring();
    }

    private Wiring wiring() {
        return mode == Mode.SYNC ? inTurns() : withMessages();
    }

    private Wiring withMessages() {
        var wiring = Wiring.of(robots + " robots in " + mode + " mode")
                .component(world())
                .component(arbitrator())
                .components("service", robots, service())
                .components("starter", robots, starter())
                .components("stopper", robots, stopper());
        if (!isDirect) {
            wiring.component(inbox())
                    .components("promise", robots, promise())
                    .bindEach("service", "promise", i -> "promise" + i);
        }
        for (int i = 1; i <= robots; i++) {
            wiring.bind("starter" + i, "service", "service" + i);
            wiring.bind("stopper" + i, "service", "service" + i);
        }
        return wiring.build();
    }

    /**
     * At each tick all have answered, in the order of the way of a colour, so that none is on its way; then each
     * service gets its reading.
     */
    private Protocol world() {
        var world = Protocol.of("world");
        chain(world, "answered ", i -> "service" + i + ".answered", isDirect ? "settled" : "promised 1");
        if (!isDirect) {
            chain(world, "promised ", i -> "promise" + i + ".idle", "judged");
            world.state("judged", requests("inbox.idle").then("settled"));
        }
        world.state("settled", requests("arbitrator.idle").then("reading 1"));
        chain(world, "reading ", i -> "service" + i + ".data", "answered 1");
        if (mayFail) {
            world.state(OVER, does("end the run").then(OVER));
        }
        return world.build();
    }

    private Protocol arbitrator() {
        var arbitrator = Protocol.of("arbitrator").state("new", does("live").then("starting 1"));
        chain(arbitrator, "starting ", i -> "starter" + i + ".send", "watching");
        arbitrator.state(
                "watching",
                isDirect
                        ? provides("colour").then("judging")
                        : provides("change").then("stopping 1"),
                provides("idle").then("watching"));
        if (isDirect) {
            arbitrator.state(
                    "judging",
                    does("ignore the colour").then("watching"),
                    does("change the state").then("stopping 1"));
        }
        chain(arbitrator, "stopping ", i -> "stopper" + i + ".send", "awaiting 1");
        chain(arbitrator, "awaiting ", i -> "stopper" + i + ".done", "starting 1");
        return arbitrator.build();
    }

    private static Protocol inbox() {
        return Protocol.of("inbox")
                .state(
                        "ready",
                        provides("colour").then("judging"),
                        provides("idle").then("ready"))
                .state(
                        "judging",
                        does("ignore the colour").then("ready"),
                        requests("arbitrator.change").then("ready"))
                .build();
    }

    private Protocol service() {
        var service = Protocol.of("service")
                .state("free", provides("begin").then("in charge"))
                .state(
                        "in charge",
                        provides("data").then("deciding"),
                        provides("answered").then("in charge"),
                        provides("stop").then("free"))
                .state(
                        "deciding",
                        does("drive on").then("in charge"),
                        does("see a colour").then("reporting"))
                .state(
                        "reporting",
                        requests(isDirect ? "arbitrator.colour" : "promise.fulfil")
                                .then("in charge"));
        if (mayFail) {
            service.state(
                            "failed",
                            provides("begin").then("in charge"),
                            provides("stop").then("failed"),
                            rejects("data").then("failed"),
                            rejects("answered").then("failed"))
                    .failsTo("failed");
        }
        return service.build();
    }

    private static Protocol promise() {
        return Protocol.of("promise")
                .state(
                        "pending",
                        provides("fulfil").then("fulfilled"),
                        provides("idle").then("pending"))
                .state("fulfilled", requests("inbox.colour").then("pending"))
                .build();
    }

    private Protocol starter() {
        return Protocol.of("starter")
                .state("free", provides("send").then("sent"))
                .state("sent", orRejected(requests("service.begin").then("free"), "free"))
                .build();
    }

    /** A stop that fails is not answered to the arbitrator, which waits until the run ends. */
    private Protocol stopper() {
        var stopper = Protocol.of("stopper")
                .state("free", provides("send").then("sent"))
                .state("sent", orRejected(requests("service.stop").then("stopped"), OVER))
                .state("stopped", provides("done").then("free"));
        if (mayFail) {
            stopper.state(OVER, does("wait for the end of the run").then(OVER));
        }
        return stopper.build();
    }

    private Branch orRejected(Branch request, String state) {
        return mayFail ? request.orRejected(state) : request;
    }

    /** One loop, which gives each service a cycle in its turn. */
    private Wiring inTurns() {
        var loop = Protocol.of("loop");
        chain(loop, "starting ", i -> "service" + i + ".start", "turn 1");
        for (int i = 1; i <= robots; i++) {
            var cycle = orRejected(requests("service" + i + ".cycle").then("after " + i), "closing 1");
            if (mayFail) {
                loop.state("turn " + i, cycle, does("lose the connection").then("closing 1"));
            } else {
                loop.state("turn " + i, cycle);
            }
            loop.state(
                    "after " + i,
                    does("see nothing new").then("turn " + (i % robots + 1)),
                    does("change the state").then("ending 1"));
        }
        chain(loop, "ending ", i -> "service" + i + ".end", "starting 1");
        var service = Protocol.of("service")
                .state("free", provides("start").then("in charge"))
                .state(
                        "in charge",
                        provides("cycle").then("in charge"),
                        provides("end").then("free"));
        if (mayFail) {
            chain(loop, "closing ", i -> "service" + i + ".end", OVER);
            loop.state(OVER, does("end the run").then(OVER));
            service.state(
                            "failed",
                            provides("end").then("free"),
                            rejects("start").then("failed"),
                            rejects("cycle").then("failed"))
                    .failsTo("failed");
        }
        return Wiring.of(robots + " robots in sync mode")
                .component(loop.build())
                .components("service", robots, service.build())
                .build();
    }

    /** One request after the other, to the component of each robot. */
    private void chain(ProtocolBuilder protocol, String state, IntFunction<String> request, String last) {
        for (int i = 1; i <= robots; i++) {
            var target = request.apply(i);
            var step = requests(target).then(i < robots ? state + (i + 1) : last);
            protocol.state(state + i, target.startsWith("service") ? orRejected(step, OVER) : step);
        }
    }
}
