package io.troupe.actor;

import io.troupe.actor.Reports.Trouble;
import io.troupe.actor.internal.Message;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.QueueEntry;
import io.troupe.actor.internal.loop.TurnOwner;
import java.time.Duration;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/** Passes the calls of a space to its observer. From any thread. */
final class ObservedCalls {
    private static final CallObserver.Party OUTSIDE = new ObservedParty("", "", CallGraph.OUTSIDE, 0);

    private ObservedCalls() {}

    /** @param spaceKey that no other space has, and which holds no space in memory */
    private record ObservedParty(Object spaceKey, String space, String name, int number) implements CallObserver.Party {
        static ObservedParty of(Home space, String name, int number) {
            return new ObservedParty(((SpaceHome) space).key, space.toString(), name, number);
        }

        @Override
        public String toString() {
            return number == 0 ? name : name + "#" + number;
        }
    }

    record ObservedCall(ActorCell actor, QueueEntry node) implements CallObserver.Call {
        @Override
        public boolean isRequest() {
            return node instanceof Request<?>;
        }

        @Override
        public boolean isPassedOn() {
            return actor.forwards();
        }

        @Override
        public Class<?> type() {
            return actor.type();
        }

        @Override
        public String method() {
            return Message.methodOf(node);
        }

        @Override
        public List<@Nullable Object> arguments() {
            return Collections.unmodifiableList(Arrays.asList(Message.argumentsOf(node)));
        }

        @Override
        public void whenSettled(Consumer<@Nullable Throwable> callback) {
            if (node instanceof Request<?> request) {
                Promise.whenSettled(
                        request, () -> false, () -> guard(actor.space(), () -> callback.accept(request.error())));
            }
        }
    }

    /** See {@link CallObserver#servedCall}. */
    static CallObserver.@Nullable Call served() {
        return Home.current() instanceof SpaceHome here ? here.served() : null;
    }

    static void held(CallObserver observer, ActorCell actor) {
        guard(actor.space(), () -> observer.held(party(actor)));
    }

    static void released(CallObserver observer, ActorCell actor) {
        guard(actor.space(), () -> observer.released(party(actor)));
    }

    static void called(CallObserver observer, ActorCell actor, QueueEntry call) {
        guard(
                actor.space(),
                () -> observer.called(
                        Home.current() instanceof SpaceHome here ? party(here.owner()) : OUTSIDE,
                        party(actor),
                        new ObservedCall(actor, call)));
    }

    static void begun(CallObserver observer, ObservedCall call) {
        guard(call.actor().space(), () -> observer.begun(party(call.actor()), call));
    }

    static void dropped(CallObserver observer, ActorCell actor, QueueEntry call) {
        guard(actor.space(), () -> observer.dropped(party(actor), new ObservedCall(actor, call)));
    }

    /** The current thread sends a result to a callback, which runs on behalf of this owner. */
    static void returned(CallObserver observer, SpaceHome space, TurnOwner reader) {
        guard(
                space,
                () -> observer.returned(
                        Home.current() instanceof SpaceHome here ? party(here.owner()) : OUTSIDE, party(reader)));
    }

    static CallObserver.Turn turnBegun(CallObserver observer, SpaceHome space, TurnOwner owner) {
        int handlers = HandlerTurn.now();
        if ((handlers & HandlerTurn.OBSERVER) != 0) {
            return CallObserver.Turn.NONE;
        }
        try {
            HandlerTurn.set(handlers | HandlerTurn.OBSERVER);
            CallObserver.Turn turn = observer.turnBegun(party(owner), space.settings.stallLimit());
            return turn == CallObserver.Turn.NONE ? turn : () -> guard(space, turn::end);
        } catch (Throwable thrown) {
            space.reports().error(Trouble.THE_OBSERVER, space, thrown);
            return CallObserver.Turn.NONE;
        } finally {
            HandlerTurn.set(handlers);
        }
    }

    /** Notifies the observer; not of what it has sent itself, which would be without end. */
    private static void guard(SpaceHome space, Runnable event) {
        int handlers = HandlerTurn.now();
        if ((handlers & HandlerTurn.OBSERVER) != 0) {
            return;
        }
        try {
            HandlerTurn.set(handlers | HandlerTurn.OBSERVER);
            event.run();
        } catch (Throwable thrown) {
            space.reports().error(Trouble.THE_OBSERVER, space, thrown);
        } finally {
            HandlerTurn.set(handlers);
        }
    }

    /** See {@link CallObserver#and}. Each is notified whatever the other one throws. */
    record Both(CallObserver first, CallObserver second) implements CallObserver {
        @Override
        public void called(Party from, Party to, Call call) {
            both(() -> first.called(from, to, call), () -> second.called(from, to, call));
        }

        @Override
        public void begun(Party actor, Call call) {
            both(() -> first.begun(actor, call), () -> second.begun(actor, call));
        }

        @Override
        public void dropped(Party actor, Call call) {
            both(() -> first.dropped(actor, call), () -> second.dropped(actor, call));
        }

        @Override
        public void held(Party actor) {
            both(() -> first.held(actor), () -> second.held(actor));
        }

        @Override
        public void released(Party actor) {
            both(() -> first.released(actor), () -> second.released(actor));
        }

        @Override
        public void returned(Party from, Party to) {
            both(() -> first.returned(from, to), () -> second.returned(from, to));
        }

        @Override
        public Turn turnBegun(Party party, @Nullable Duration stallLimit) {
            Turn one = turn(first, party, stallLimit);
            Turn two = turn(second, party, stallLimit);
            return () -> both(one::end, two::end);
        }

        /** Begins a turn; what the observer throws is thrown at the end of it. */
        private static Turn turn(CallObserver observer, Party party, @Nullable Duration stallLimit) {
            try {
                return observer.turnBegun(party, stallLimit);
            } catch (RuntimeException | Error thrown) {
                return () -> {
                    throw thrown;
                };
            }
        }

        private static void both(Runnable one, Runnable two) {
            try {
                one.run();
            } catch (Throwable thrown) {
                try {
                    two.run();
                } catch (Throwable also) {
                    thrown.addSuppressed(also);
                }
                throw thrown;
            }
            two.run();
        }
    }

    private static CallObserver.Party party(TurnOwner owner) {
        return owner instanceof Incarnation life
                ? party(life.cell())
                : ObservedParty.of(owner.home(), CallGraph.TASKS, 0);
    }

    private static CallObserver.Party party(ActorCell actor) {
        return ObservedParty.of(actor.space(), actor.label(), actor.unnamedNumber());
    }
}
