package io.troupe.actor.model;

import io.troupe.actor.model.Act.Kind;
import java.util.EnumSet;
import java.util.List;
import java.util.Set;

/**
 * Whether and when a program closes its space, and which kinds of acts it leaves out. A callback whose reader belongs
 * to no actor receives no results after its space is closed, but in the model it does. So no such callback is open
 * then.
 */
enum Ending {
    NEVER,
    /** When all acts are done. */
    AT_THE_END,
    /** At any act. */
    ANY_TIME;

    private static final Set<Kind> CALLBACKS = EnumSet.of(Kind.OPEN, Kind.FORWARD, Kind.NEXT, Kind.FINISH, Kind.FAIL);

    /** The kinds of acts that the program does not contain. */
    boolean leavesOut(Kind kind) {
        return this != ANY_TIME && kind == Kind.CLOSE;
    }

    /** The kinds of acts that are not done outside an actor. */
    Set<Kind> notByNobody() {
        return this == ANY_TIME ? EnumSet.of(Kind.OPEN) : EnumSet.noneOf(Kind.class);
    }

    /** The kinds of acts that listeners do not do. */
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
