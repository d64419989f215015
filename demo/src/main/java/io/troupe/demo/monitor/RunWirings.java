package io.troupe.demo.monitor;

import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.requests;

import io.troupe.petri.wiring.Protocol;
import io.troupe.petri.wiring.ProtocolBuilder;
import io.troupe.petri.wiring.Wiring;
import io.troupe.services.subsumption.Mode;
import java.util.function.IntFunction;

/**
 * The main job as declarations that a run can be compared with, message by message, in each of the three modes.
 *
 * <p>A call that its caller does not wait for is a component: the starter and the stopper of a robot are the messages
 * with which the arbitrator starts and stops its service, and the promise is that of its colour. The inbox judges each
 * colour, and drops those that come too late. At each tick the world finds all of them at rest; ADR 0003 defines when
 * an actor space has answered a reading. In callback mode all colours of one reading are one message, and the promise
 * is the way of these messages.
 *
 * <p>A service that has ended looks like one that waits for readings: a request to stop it is answered at once. Closing
 * a run is not part of the declarations.
 */
final class RunWirings {
    private RunWirings() {}

    static Wiring of(Mode mode, int robots) {
        return mode == Mode.SYNC ? inTurns(robots) : withMessages(mode, robots);
    }

    private static Wiring withMessages(Mode mode, int robots) {
        var wiring = Wiring.of(robots + " robots in " + mode + " mode")
                .component(world(robots))
                .component(arbitrator(robots))
                .component(inbox())
                .components("service", robots, service())
                .components("promise", robots, promise())
                .components("starter", robots, starter())
                .components("stopper", robots, stopper());
        for (int i = 1; i <= robots; i++) {
            wiring.bind("service" + i, "promise", "promise" + i);
            wiring.bind("starter" + i, "service", "service" + i);
            wiring.bind("stopper" + i, "service", "service" + i);
        }
        return wiring.build();
    }

    /**
     * At each tick all have answered, in the order of the way of a colour, so that none is on its way; then each
     * service gets its reading.
     */
    private static Protocol world(int robots) {
        var world = Protocol.of("world");
        chain(world, "answered ", robots, i -> "service" + i + ".answered", "promised 1");
        chain(world, "promised ", robots, i -> "promise" + i + ".idle", "judged");
        world.in("judged", requests("inbox.idle").then("settled"));
        world.in("settled", requests("arbitrator.idle").then("reading 1"));
        chain(world, "reading ", robots, i -> "service" + i + ".data", "answered 1");
        return world.build();
    }

    private static Protocol arbitrator(int robots) {
        var arbitrator = Protocol.of("arbitrator").in("new", does("live").then("starting 1"));
        chain(arbitrator, "starting ", robots, i -> "starter" + i + ".send", "watching");
        arbitrator.in(
                "watching",
                provides("change").then("stopping 1"),
                provides("idle").then("watching"));
        chain(arbitrator, "stopping ", robots, i -> "stopper" + i + ".send", "awaiting 1");
        chain(arbitrator, "awaiting ", robots, i -> "stopper" + i + ".done", "starting 1");
        return arbitrator.build();
    }

    private static Protocol inbox() {
        return Protocol.of("inbox")
                .in(
                        "ready",
                        provides("colour").then("judging"),
                        provides("idle").then("ready"))
                .in(
                        "judging",
                        does("ignore the colour").then("ready"),
                        requests("arbitrator.change").then("ready"))
                .build();
    }

    private static Protocol service() {
        return Protocol.of("service")
                .in("free", provides("begin").then("in charge"))
                .in(
                        "in charge",
                        provides("data").then("deciding"),
                        provides("answered").then("in charge"),
                        provides("stop").then("free"))
                .in(
                        "deciding",
                        does("drive on").then("in charge"),
                        does("see a colour").then("reporting"))
                .in("reporting", requests("promise.fulfil").then("in charge"))
                .build();
    }

    private static Protocol promise() {
        return Protocol.of("promise")
                .in(
                        "pending",
                        provides("fulfil").then("fulfilled"),
                        provides("idle").then("pending"))
                .in("fulfilled", requests("inbox.colour").then("pending"))
                .build();
    }

    private static Protocol starter() {
        return Protocol.of("starter")
                .in("free", provides("send").then("sent"))
                .in("sent", requests("service.begin").then("free"))
                .build();
    }

    private static Protocol stopper() {
        return Protocol.of("stopper")
                .in("free", provides("send").then("sent"))
                .in("sent", requests("service.stop").then("stopped"))
                .in("stopped", provides("done").then("free"))
                .build();
    }

    /** One loop, which gives each service a cycle in its turn. */
    private static Wiring inTurns(int robots) {
        var loop = Protocol.of("loop");
        chain(loop, "starting ", robots, i -> "service" + i + ".start", "turn 1");
        for (int i = 1; i <= robots; i++) {
            loop.in("turn " + i, requests("service" + i + ".cycle").then("after " + i));
            loop.in(
                    "after " + i,
                    does("see nothing new").then("turn " + (i % robots + 1)),
                    does("change the state").then("ending 1"));
        }
        chain(loop, "ending ", robots, i -> "service" + i + ".end", "starting 1");
        return Wiring.of(robots + " robots in sync mode")
                .component(loop.build())
                .components(
                        "service",
                        robots,
                        Protocol.of("service")
                                .in("free", provides("start").then("in charge"))
                                .in(
                                        "in charge",
                                        provides("cycle").then("in charge"),
                                        provides("end").then("free"))
                                .build())
                .build();
    }

    /** One request after the other, to the component of each robot. */
    private static void chain(
            ProtocolBuilder protocol, String state, int robots, IntFunction<String> request, String last) {
        for (int i = 1; i <= robots; i++) {
            protocol.in(state + i, requests(request.apply(i)).then(i < robots ? state + (i + 1) : last));
        }
    }
}
