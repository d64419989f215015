package io.troupe.actor.model;

import io.troupe.actor.model.Act.Kind;
import java.util.EnumSet;
import java.util.List;
import java.util.Set;

/**
 * Whether and when a program closes its space, and what it leaves out.
 *
 * <p>It leaves out what the library does not do as it is documented; the model does. Each comes back as soon as that is mended.
 *
 * <ul>
 *   <li>A promise that {@code then} makes in a listener registered outside counts as one made outside: its error is reported a second late. So listeners
 *       register no listeners.
 *   <li>A {@code delay} that is begun while a closed space turns away what is left stays pending. So listeners, which still run then, begin none.
 *   <li>A callback whose reader is no actor's hears nothing any more when its space is closed, not even that the call was turned away. So none
 *       is in use then.
 *   <li>Timers that are due and actions that wait for quiet run behind the entry that ends serving, or the actions are lost. So nothing is due or
 *       waits for quiet then.
 *   <li>An actor whose start waits when the space is closed starts if a call of it is turned away before. So no start waits then.
 * </ul>
 */
enum Ending {
    NEVER,
    /** When all has been done. */
    AT_THE_END,
    /** In the midst of things. */
    ANY_TIME;

    private static final Set<Kind> LISTENING = EnumSet.of(Kind.THEN, Kind.HANDLE, Kind.WHEN, Kind.RESCUE, Kind.COMPOSE);
    private static final List<Integer> DELAYS = List.of(0, 1, 2, 3, 20, 20, 100, 1_100);

    /** What no act of the program is. */
    boolean leavesOut(Kind kind) {
        return this == ANY_TIME ? kind == Kind.ADVANCE || kind == Kind.ON_IDLE : kind == Kind.CLOSE;
    }

    /** What those who are no actor do not do. */
    Set<Kind> notByNobody() {
        return this == ANY_TIME ? EnumSet.of(Kind.OPEN) : EnumSet.noneOf(Kind.class);
    }

    /** What listeners do not do themselves. */
    Set<Kind> notInListeners() {
        var kinds = EnumSet.copyOf(LISTENING);
        switch (this) {
            case NEVER -> {}
            case AT_THE_END ->
                kinds.addAll(Set.of(Kind.DELAY, Kind.OPEN, Kind.FORWARD, Kind.NEXT, Kind.FINISH, Kind.FAIL));
            case ANY_TIME -> kinds.addAll(Set.of(Kind.DELAY, Kind.OPEN, Kind.SPAWN));
        }
        return kinds;
    }

    boolean awaitsEachStart() {
        return this == ANY_TIME;
    }

    List<Integer> delays() {
        return this == ANY_TIME ? DELAYS.subList(1, DELAYS.size()) : DELAYS;
    }

    List<Act> lastActs() {
        var crank = Act.of(Kind.CRANK, 0, 0, 0);
        var close = Act.of(Kind.CLOSE, 0, 0, 0);
        return switch (this) {
            case NEVER -> List.of();
            case AT_THE_END -> List.of(crank, close);
            case ANY_TIME -> List.of(close);
        };
    }
}
