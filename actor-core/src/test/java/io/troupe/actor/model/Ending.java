package io.troupe.actor.model;

import io.troupe.actor.model.Act.Kind;
import java.util.EnumSet;
import java.util.List;
import java.util.Set;

/**
 * Whether and when a program closes its space, and what it leaves out: a callback whose reader is no actor's hears no
 * results any more when its space is closed, but the model has it hear everything. So none is open then.
 */
enum Ending {
    NEVER,
    /** When all has been done. */
    AT_THE_END,
    /** In the midst of things. */
    ANY_TIME;

    private static final Set<Kind> CALLBACKS = EnumSet.of(Kind.OPEN, Kind.FORWARD, Kind.NEXT, Kind.FINISH, Kind.FAIL);

    /** What no act of the program is. */
    boolean leavesOut(Kind kind) {
        return this != ANY_TIME && kind == Kind.CLOSE;
    }

    /** What those who are no actor do not do. */
    Set<Kind> notByNobody() {
        return this == ANY_TIME ? EnumSet.of(Kind.OPEN) : EnumSet.noneOf(Kind.class);
    }

    /** What listeners do not do themselves. */
    Set<Kind> notInListeners() {
        return switch (this) {
            case NEVER -> EnumSet.noneOf(Kind.class);
            case AT_THE_END -> CALLBACKS;
            case ANY_TIME -> EnumSet.of(Kind.OPEN);
        };
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
