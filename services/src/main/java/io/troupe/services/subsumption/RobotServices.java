package io.troupe.services.subsumption;

import io.troupe.actor.Actor;
import io.troupe.actor.promise.Promise;
import io.troupe.services.behaviour.ColourFinder;
import io.troupe.services.behaviour.SpaceWanderer;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import java.util.Map;
import java.util.OptionalInt;
import java.util.TreeMap;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.IntPredicate;
import org.jspecify.annotations.Nullable;

/**
 * The actor as a service: offers wall following and space wandering to other actors.
 *
 * <p><b>Role.</b> Spawn it, and call it through its proxy. It connects to a robot when it is first asked to drive it and keeps the connection.
 * <p><b>Order.</b> A robot never has two services: one that is called while another is about to stop begins when that has stopped.
 * <p><b>Units and shapes.</b> Robots by Player index, from 0. A reference is 1 = run, 0 = stop, 2 = stopped and zero speed sent; whoever calls a service
 * sets it to 1 before and to 0 to end it.
 * <p><b>Errors.</b> A robot that does not exist, or whose service was not told to stop, rejects the promise; so does a server that goes away.
 * <p><b>Source.</b> Paper, sections 3.5 and 3.6, Figures 17 and 20.
 */
public class RobotServices extends Actor {
    /** Where the robots are and how they are driven. */
    public record Settings(
            String host, int port, CornerStyle cornerStyle, IntPredicate coloursOfInterest, ServiceObserver observer) {
        /** The paper's: its three colours, its corner style, the default port on this machine. */
        public static Settings ofThePaper() {
            var table = SubsumptionTable.ofThePaper();
            return new Settings(
                    "localhost",
                    6665,
                    CornerStyle.FORWARD,
                    colour -> table.state(colour).isPresent(),
                    ServiceObserver.NONE);
        }

        public Settings withObserver(ServiceObserver newObserver) {
            return new Settings(host, port, cornerStyle, coloursOfInterest, newObserver);
        }

        public Settings withPort(int newPort) {
            return new Settings(host, newPort, cornerStyle, coloursOfInterest, observer);
        }

        public Settings withCornerStyle(CornerStyle newCornerStyle) {
            return new Settings(host, port, newCornerStyle, coloursOfInterest, observer);
        }
    }

    private final Settings settings;
    private final Map<Integer, RobotLink> links = new TreeMap<>();
    private final Map<Integer, ServiceLoop> inCharge = new TreeMap<>();

    public RobotServices(Settings settings) {
        this.settings = settings;
    }

    /**
     * Lets a robot follow the wall on its left until the reference is cleared.
     *
     * @return fulfilled when it has stopped
     */
    public Promise<@Nullable Void> wallFollower(int robot, AtomicReference<Integer> reference) {
        var follower = new WallFollower(settings.cornerStyle());
        var memory = new WallFollower.Memory[] {WallFollower.START};
        return begin(robot, Service.WALL_FOLLOWER, reference, (link, first) -> {
            var step = follower.step(memory[0], link.sonar());
            memory[0] = step.memory();
            return step.velocity();
        });
    }

    /**
     * Lets a robot wander until it sees a colour of interest that is not the state's own, or the reference is cleared.
     *
     * @param colourFinder 1 = look for colours meanwhile; 2 when it has stopped
     * @param stateColour the colour of the present state
     * @return the colour seen; the state's own if the robot was stopped before it saw another
     */
    public Promise<Integer> spaceWanderer(
            int robot, AtomicReference<Integer> reference, AtomicReference<Integer> colourFinder, int stateColour) {
        var seen = new int[] {stateColour};
        return begin(robot, Service.SPACE_WANDERER, reference, (link, first) -> {
                    // the reading at hand has had its say: two robots that each see the other's colour would else
                    // switch for ever, and never move
                    OptionalInt colour = !first && colourFinder.get() == ServiceLoop.RUN
                            ? ColourFinder.find(
                                    link.sightings(),
                                    each -> each != stateColour
                                            && settings.coloursOfInterest().test(each))
                            : OptionalInt.empty();
                    if (colour.isPresent()) {
                        seen[0] = colour.getAsInt();
                        reference.set(ServiceLoop.STOP);
                        return Velocity.STOP;
                    }
                    return SpaceWanderer.steer(link.sonar());
                })
                .whenComplete((stopped, error) -> colourFinder.set(ServiceLoop.STOPPED))
                .thenApply(stopped -> seen[0]);
    }

    /**
     * Clears a reference and makes its service notice at once, instead of at the next reading.
     *
     * @return fulfilled when the service has stopped; at once if none runs with that reference
     */
    public Promise<@Nullable Void> stop(AtomicReference<Integer> reference) {
        reference.compareAndSet(ServiceLoop.RUN, ServiceLoop.STOP);
        for (var loop : inCharge.values()) {
            if (loop.reference() == reference) {
                loop.wake();
                return loop.ended();
            }
        }
        return Promise.done();
    }

    @Override
    protected void stopped() {
        links.values().forEach(RobotLink::close);
        links.clear();
    }

    private Promise<@Nullable Void> begin(
            int robot, Service service, AtomicReference<Integer> reference, ServiceLoop.Cycle cycle) {
        ServiceLoop before = inCharge.get(robot);
        if (before == null) {
            return start(robot, service, reference, cycle);
        }
        if (before.isToRun()) {
            throw new IllegalStateException("robot " + robot + " is in the charge of " + before.service()
                    + " and was to get " + service + ": set the reference of the first to 0 before");
        }
        before.wake();
        return before.ended()
                .handle((stopped, error) -> null)
                .thenCompose(free -> begin(robot, service, reference, cycle));
    }

    private Promise<@Nullable Void> start(
            int robot, Service service, AtomicReference<Integer> reference, ServiceLoop.Cycle cycle) {
        for (var other : inCharge.values()) {
            if (other.reference() == reference) {
                throw new IllegalStateException("the reference for " + service + " of robot " + robot + " belongs to "
                        + other.service() + " of another robot: give each service a reference of its own");
            }
        }
        RobotLink link =
                links.computeIfAbsent(robot, index -> RobotLink.connect(settings.host(), settings.port(), index));
        var loop = new ServiceLoop(space(), robot, service, link, reference, cycle, settings.observer());
        inCharge.put(robot, loop);
        return loop.ended().whenComplete((stopped, error) -> inCharge.remove(robot, loop));
    }
}
