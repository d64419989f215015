package io.troupe.sim;

import io.troupe.sim.PortServer.Offer;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/**
 * What a client has told its devices and the world does not know yet.
 *
 * <p><b>Order.</b> What it says before its answer to a tick counts at the end of that tick; what it says after it counts at the end of the next, however
 * long the other clients take. The newest command to a device replaces an older one, so a client that never stops talking needs no more room.
 * <p><b>Threads.</b> None of its own; guarded by the simulation's lock.
 */
final class PendingCommands {
    /** What a device can be told at the same time. */
    enum Kind {
        RESET,
        PLACE,
        ODOMETRY,
        POWER,
        SPEED
    }

    private record Subject(Offer device, Kind kind) {}

    private final Map<Subject, Runnable> now = new LinkedHashMap<>();
    private final Map<Subject, Runnable> later = new LinkedHashMap<>();

    /**
     * @param late whether the client has answered the tick that is being played
     */
    void add(Offer device, Kind kind, Runnable command, boolean late) {
        (late ? later : now).put(new Subject(device, kind), command);
    }

    /** A new tick begins. */
    void tickBegins() {
        now.putAll(later);
        later.clear();
    }

    /** All that one device was told, for a client that leaves it. */
    List<Runnable> takeAll(Offer device) {
        var taken = new ArrayList<Runnable>();
        for (var commands : List.of(now, later)) {
            for (var kind : Kind.values()) {
                Runnable command = commands.remove(new Subject(device, kind));
                if (command != null) {
                    taken.add(command);
                }
            }
        }
        return taken;
    }

    /** All that any device was told, for a client that goes. */
    List<Runnable> takeAll() {
        var taken = new ArrayList<>(now.values());
        taken.addAll(later.values());
        now.clear();
        later.clear();
        return taken;
    }

    /** What counts at the end of this tick. */
    List<Runnable> take() {
        var taken = new ArrayList<>(now.values());
        now.clear();
        return taken;
    }
}
