package io.troupe.actor.model;

import io.troupe.actor.model.Act.Answer;
import io.troupe.actor.model.Act.Kind;
import java.util.ArrayList;
import java.util.Collections;
import java.util.EnumSet;
import java.util.List;
import java.util.Random;
import java.util.Set;

/** Generates random programs; the same seed generates the same program. */
final class Programs {
    private static final int ACTORS = 3;
    private static final int DEPTH = 4;
    private static final Act RUN = Act.of(Kind.RUN, 0, 0, 0);
    private static final Act CLOSE = Act.of(Kind.CLOSE, 0, 0, 0);
    private static final Set<Kind> OUTSIDE_ONLY = EnumSet.of(Kind.RUN, Kind.ADVANCE);
    private static final Set<Kind> INSIDE_ONLY =
            EnumSet.of(Kind.THROW, Kind.STOP_SELF, Kind.HOLD, Kind.RELEASE, Kind.AFTER, Kind.EVERY, Kind.CANCEL_TIMER);
    private static final Set<Kind> STREAMING = EnumSet.of(Kind.OPEN, Kind.FORWARD, Kind.NEXT, Kind.SPAWN);
    private static final Set<Kind> MULTIPLYING = EnumSet.of(Kind.EVERY, Kind.SPAWN);

    private static final List<Integer> DELAYS = List.of(0, 1, 2, 3, 20, 20, 100, 1_100);
    private static final Set<Kind> NONE = EnumSet.noneOf(Kind.class);

    /**
     * Whether and when a program closes its space, and which kinds of acts it leaves out. A callback whose reader
     * belongs to no actor receives no results after its space is closed, but in the model it does. So no such callback
     * is open then.
     */
    private enum Ending {
        NEVER(NONE, NONE),
        /** When all acts are done. */
        AT_THE_END(NONE, EnumSet.of(Kind.OPEN, Kind.FORWARD, Kind.NEXT, Kind.FINISH, Kind.FAIL), RUN, CLOSE),
        /** At any act. */
        ANY_TIME(EnumSet.of(Kind.OPEN), EnumSet.of(Kind.OPEN), CLOSE);

        private final Set<Kind> notByNobody; // the kinds of acts that are not done outside an actor
        private final Set<Kind> notInListeners;
        private final List<Act> lastActs;

        Ending(Set<Kind> notByNobody, Set<Kind> notInListeners, Act... lastActs) {
            this.notByNobody = notByNobody;
            this.notInListeners = notInListeners;
            this.lastActs = List.of(lastActs);
        }
    }

    private final Random random;
    private final Ending ending;
    private final List<Kind> deck = new ArrayList<>();
    private final List<Integer> promises = new ArrayList<>(List.of(0));
    private final List<Integer> deferreds = new ArrayList<>(List.of(0));
    private final List<Integer> streams = new ArrayList<>(List.of(0));
    private final List<Integer> timers = new ArrayList<>(List.of(0));
    private int lastId;

    private Programs(long seed) {
        random = new Random(seed);
        ending = Ending.values()[random.nextInt(3)];
        for (Kind kind : Kind.values()) {
            if (kind != Kind.READER && (kind != Kind.CLOSE || ending == Ending.ANY_TIME)) {
                deck.addAll(Collections.nCopies(frequency(kind, random.nextInt(7)), kind));
            }
        }
    }

    /** Some kinds are frequent and some do not occur, so that rare ones meet. */
    private int frequency(Kind kind, int number) {
        int often = Math.max(0, number - 2);
        return switch (kind) {
            case ADVANCE, THROW -> 2 + random.nextInt(3);
            case TELL, ASK -> 6;
            case CLOSE -> often / 4; // nothing follows it
            case HOLD -> often / 2; // what follows may wait for ever
            case STOP, STOP_SELF -> often / 3; // little happens to a stopped actor
            default -> often;
        };
    }

    static List<Act> random(long seed) {
        return new Programs(seed).program();
    }

    private List<Act> program() {
        var acts = new ArrayList<Act>();
        for (int actor = 0; actor < ACTORS; actor++) {
            acts.add(spawn(actor, 0));
        }
        if (random.nextInt(3) > 0) {
            acts.add(RUN);
        }
        int length = 4 + random.nextInt(36);
        for (int i = 0; i < length; i++) {
            acts.add(random.nextInt(5) == 0 ? RUN : act(0, INSIDE_ONLY, ending.notByNobody));
        }
        acts.addAll(ending.lastActs);
        return List.copyOf(acts);
    }

    private List<Act> script(int depth, Set<Kind> banned) {
        return script(depth, banned, NONE);
    }

    /**
     * Generates acts.
     *
     * @param banned the kinds that occur neither here nor in nested scripts
     * @param notHere the kinds that occur only in nested scripts
     */
    private List<Act> script(int depth, Set<Kind> banned, Set<Kind> notHere) {
        var acts = new ArrayList<Act>();
        int length = depth >= DEPTH ? 0 : Math.max(0, random.nextInt(6) - 1 - depth / 2);
        for (int i = 0; i < length; i++) {
            acts.add(act(depth, banned, notHere));
        }
        return List.copyOf(acts);
    }

    private static Set<Kind> union(Set<Kind> first, Set<Kind> second) {
        var both = EnumSet.copyOf(first);
        both.addAll(second);
        return both;
    }

    private Act act(int depth, Set<Kind> banned, Set<Kind> notHere) {
        Kind kind = deck.get(random.nextInt(deck.size()));
        while (banned.contains(kind) || notHere.contains(kind)) {
            kind = random.nextBoolean() ? Kind.TELL : deck.get(random.nextInt(deck.size()));
        }
        var below = union(OUTSIDE_ONLY, banned);
        below.removeAll(INSIDE_ONLY);
        int id = ++lastId;
        return switch (kind) {
            case RUN, CLOSE, STOP_SELF, HOLD, RELEASE, THROW -> Act.of(kind, id, 0, 0);
            case ADVANCE -> Act.of(kind, 0, 0, oneOf(List.of(1, 2, 3, 10, 10, 10, 200, 2_100)));
            case SPAWN -> spawn(actor(), depth);
            case STOP -> Act.of(kind, id, actor(), 0);
            case WATCH, DEFER -> Act.of(kind, made(promises, kind == Kind.DEFER), actor(), 0);
            case DELAY -> Act.of(kind, made(promises, false), 0, oneOf(DELAYS));
            case TELL, FORWARD ->
                new Act(kind, kind == Kind.TELL ? id : oneOf(streams), actor(), 0, script(depth + 1, below));
            case ASK -> ask(depth, below);
            case RESOLVE, REJECT -> Act.of(kind, id, oneOf(deferreds), 0);
            case CANCEL -> Act.of(kind, id, oneOf(promises), 0);
            case THEN, HANDLE, WHEN, RESCUE, COMPOSE -> {
                int target = oneOf(promises);
                int other = oneOf(promises);
                var script = script(depth + 1, below, ending.notInListeners);
                yield new Act(kind, made(promises, false), target, other, script);
            }
            case LIMIT, INSTEAD -> {
                int target = oneOf(promises);
                yield Act.of(kind, made(promises, false), target, oneOf(DELAYS));
            }
            case OPEN -> open(depth, below);
            case NEXT -> Act.of(kind, id, oneOf(streams), random.nextInt(60) == 0 ? 300 : 1 + random.nextInt(3));
            case FINISH, FAIL, CANCEL_STREAM, LOOK_AT_STREAM -> Act.of(kind, id, oneOf(streams), 0);
            case AFTER, EVERY -> {
                int delay = kind == Kind.AFTER ? oneOf(DELAYS) : oneOf(List.of(20, 100, 1_000));
                var inTimer = kind == Kind.EVERY ? union(below, MULTIPLYING) : below;
                yield new Act(kind, made(timers, false), 0, delay, script(depth + 1, inTimer));
            }
            case CANCEL_TIMER -> Act.of(kind, id, oneOf(timers), 0);
            case EXECUTE, ON_IDLE -> {
                below.addAll(union(INSIDE_ONLY, OUTSIDE_ONLY));
                below.remove(Kind.THROW);
                yield new Act(kind, id, 0, 0, script(depth + 1, below, ending.notByNobody));
            }
            case READER -> throw new IllegalStateException("a reader is no act of its own");
        };
    }

    private Act spawn(int actor, int depth) {
        int variant =
                random.nextInt(3) == 0 ? random.nextInt(Act.Cast.SUPERVISIONS) : random.nextInt(Act.Cast.VARIANTS);
        var banned = union(EnumSet.of(Kind.SPAWN, Kind.THROW), OUTSIDE_ONLY);
        return new Act(Kind.SPAWN, ++lastId, actor, variant, script(depth + 2, banned));
    }

    private Act ask(int depth, Set<Kind> below) {
        int id = made(promises, false);
        int answer = random.nextInt(Answer.values().length);
        if (answer == Answer.LATER.ordinal()) {
            made(promises, true); // the id after that of the request
        } else if (answer == Answer.OTHER.ordinal()) {
            answer += 1 + oneOf(promises);
        }
        return new Act(Kind.ASK, id, actor(), answer, script(depth + 1, below));
    }

    /** A reader sends nothing, because it could otherwise go on for ever. */
    private Act open(int depth, Set<Kind> below) {
        int id = made(streams, false);
        promises.add(id); // the result's, if it is a request
        var reader = new Act(Kind.READER, 0, 0, 0, script(depth + 2, union(below, STREAMING)));
        var script = new ArrayList<>(script(depth + 1, below));
        script.addFirst(reader);
        return new Act(Kind.OPEN, id, actor(), random.nextInt(4 * 4), List.copyOf(script));
    }

    private int actor() {
        return random.nextInt(ACTORS);
    }

    private int made(List<Integer> kind, boolean byHand) {
        int id = ++lastId;
        kind.add(id);
        if (byHand) {
            deferreds.add(id);
        }
        return id;
    }

    /** One of the most recent ids. */
    private int oneOf(List<Integer> choices) {
        int last = choices.size();
        return choices.get(last - 1 - random.nextInt(Math.min(last, 8)));
    }
}
