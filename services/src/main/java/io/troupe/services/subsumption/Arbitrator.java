package io.troupe.services.subsumption;

import io.troupe.actor.Actor;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/**
 * Decides which service drives which robot, by the colours that the robots see: the paper's main code in promise mode.
 *
 * <p><b>Role.</b> Spawn it, and send {@link #live} once; it calls itself from then on.
 * <p><b>Order.</b> A switch: the wanderer that has seen a colour has ended itself; all other services are told to stop; when all of them have stopped,
 * the services of the next state begin. That all happens between two readings, so every robot always has exactly one service.
 * If two robots see colours at once, the first promise to be fulfilled counts (the robot with the lower index).
 * <p><b>Errors.</b> What rejects a service's promise rejects {@link #ended}.
 * <p><b>Source.</b> Paper, section 3.6, Figure 20.
 */
public class Arbitrator extends Actor {
    /** Is told of every state that begins. Called on the actor space's thread. */
    @FunctionalInterface
    public interface StateListener {
        /**
         * A state begins.
         *
         * @param seenBy index of the robot that saw its colour; null for the first state
         */
        void began(State state, @Nullable Integer seenBy);

        /** A message with a colour has arrived, whatever comes of it. */
        default void colourReceived(int robot, int colour) {}
    }

    private final RobotServices services;
    private final SubsumptionTable table;
    private final StateListener listener;
    private final Deferred<@Nullable Void> ended = new Deferred<>();
    private final Map<Integer, AtomicReference<Integer>> references = new TreeMap<>();
    private State state;
    private @Nullable Integer seenBy;
    private int switches;

    public Arbitrator(RobotServices services, SubsumptionTable table, StateListener listener) {
        this.services = services;
        this.table = table;
        this.listener = listener;
        this.state = table.first();
    }

    /** Puts the services of the present state in charge. */
    public void live() {
        listener.began(state, seenBy);
        for (int robot = 0; robot < state.services().size(); robot++) {
            begin(robot);
        }
    }

    /** Rejected when a service fails; never fulfilled. */
    public Promise<@Nullable Void> ended() {
        return ended;
    }

    private void begin(int robot) {
        State present = state;
        int switchesBefore = switches;
        var reference = new AtomicReference<>(ServiceLoop.RUN);
        references.put(robot, reference);
        Service service = present.services().get(robot);
        ColourRule rule = service.findsColours() ? table.ruleIn(present) : ColourRule.NONE;
        var colourFinder = new AtomicReference<>(service.findsColours() ? ServiceLoop.RUN : ServiceLoop.STOP);
        Promise<?> end = services.serve(robot, service, reference, colourFinder, rule)
                .thenAccept(colour -> {
                    if (colour.isPresent()) {
                        listener.colourReceived(robot, colour.getAsInt());
                        if (switches == switchesBefore) {
                            seen(robot, colour.getAsInt());
                        } // else the switch is under way: this one saw something at the same time
                    }
                });
        end.exceptionally(error -> {
            ended.reject(error);
            return null;
        });
    }

    /** A robot has seen a colour: the first one to do so in a state ends it. One that leads nowhere leaves the robot its service. */
    private void seen(int robot, int colour) {
        table.next(state, colour).ifPresentOrElse(next -> change(next, robot), () -> begin(robot));
    }

    private void change(State next, int robot) {
        state = next;
        switches++;
        seenBy = robot;
        var stops = references.values().stream().map(services::stop).toList();
        references.clear();
        Promise.all(stops).thenRun(() -> ((Arbitrator) self()).live());
    }
}
