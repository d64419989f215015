package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.wiring.ProtocolEvent.Kind;
import io.troupe.petri.wiring.Step.Takes.Outcome;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * Executes the declarations of a wiring, one step at a time: a second implementation of what a declaration means, that
 * knows no net. Tests compare the nets, the verdicts and the monitor with it.
 */
final class Simulation {
    /** What a component does at the moment. */
    sealed interface Status {
        record In(String state) implements Status {}

        /** Has chosen a step that may have to wait. */
        record Decided(Step.Waiting step) implements Status {}

        record Waiting(Step.Requests request) implements Status {}

        record Served(Step.Requests request) implements Status {}

        /** Its request is accepted, to be answered later. */
        record Accepted(Step.Requests request) implements Status {}

        /** Serves a call of {@code caller}, who has made a request, has asked a question, or has given up. */
        record Serving(Step.Provides offer, String caller, For what, boolean isDone) implements Status {}

        /** Is left by all that call it, and does not fail any more. */
        record Left(String state) implements Status {}

        /** Has failed and rejects these accepted calls, one by one. */
        record Owing(List<String> calls) implements Status {}

        /** Has failed and closes its questions and streams; {@code number} of them are closed. */
        record Closing(int number) implements Status {}
    }

    enum For {
        REQUEST,
        QUESTION,
        NOBODY
    }

    enum Phase {
        ASKED,
        OPEN,
        ACCEPTED,
        SETTLED,
        REJECTED
    }

    /**
     * A state of all components; {@code questions}, {@code items} and {@code gone} (accepted calls whose callers gave
     * them up) by {@code caller>component.call}.
     */
    record World(
            Map<String, Status> at,
            Map<String, List<String>> mail,
            Map<String, List<String>> holds,
            Map<String, Phase> questions,
            Map<String, Integer> items,
            Map<String, Integer> gone) {
        static World start(Wiring wiring) {
            var world = new World(
                    new TreeMap<>(),
                    new TreeMap<>(),
                    new TreeMap<>(),
                    new TreeMap<>(),
                    new TreeMap<>(),
                    new TreeMap<>());
            for (var component : wiring.components()) {
                world.at.put(
                        component,
                        new Status.In(wiring.protocol(component).states().get(0)));
                world.mail.put(component, List.of());
                world.holds.put(component, List.of());
            }
            return world;
        }

        World copy() {
            return new World(
                    new TreeMap<>(at),
                    new TreeMap<>(mail),
                    new TreeMap<>(holds),
                    new TreeMap<>(questions),
                    new TreeMap<>(items),
                    new TreeMap<>(gone));
        }
    }

    /**
     * A step.
     *
     * @param event what is seen of it; null = nothing
     * @param mayBeUnseen whether it need not be reported
     * @param who the components that take part
     */
    record Move(@Nullable ProtocolEvent event, boolean mayBeUnseen, Set<String> who, World next) {
        /** The event, if steps with these labels are observed. */
        Optional<ProtocolEvent> seen(Set<String> observed) {
            return Optional.ofNullable(event).filter(each -> each.kind() != Kind.DID || observed.contains(each.what()));
        }

        boolean mayBeUnseen(Set<String> observed) {
            return mayBeUnseen || seen(observed).isEmpty();
        }
    }

    private final Wiring wiring;
    private final Map<String, Map<String, Set<String>>> mayBeOpen = new TreeMap<>(); // by component and state
    private final Map<World, List<Move>> worlds = new LinkedHashMap<>();
    private final boolean isComplete;

    /** Finds all worlds, or stops at more than {@code most}. */
    Simulation(Wiring wiring, int most) {
        this.wiring = wiring;
        wiring.components().forEach(component -> mayBeOpen.put(component, wiring.openQuestions(component)));
        var ahead = new ArrayDeque<>(List.of(World.start(wiring)));
        var seen = new HashSet<>(ahead);
        while (!ahead.isEmpty() && seen.size() <= most) {
            var world = ahead.remove();
            var moves = new Interpreter(wiring, mayBeOpen, world).moves();
            finished(world).forEach(component -> left(world, component).ifPresent(moves::add));
            worlds.put(world, moves);
            moves.stream().map(Move::next).filter(seen::add).forEach(ahead::add);
        }
        isComplete = ahead.isEmpty();
    }

    boolean isComplete() {
        return isComplete;
    }

    World start() {
        return World.start(wiring);
    }

    Set<World> worlds() {
        return worlds.keySet();
    }

    List<Move> moves(World world) {
        return requireNonNull(worlds.get(world));
    }

    int edges() {
        return worlds.values().stream().mapToInt(List::size).sum();
    }

    /** The worlds in which nothing can happen, although some component waits. */
    int dead() {
        return (int) worlds.keySet().stream().filter(this::isDead).count();
    }

    boolean isDead(World world) {
        return moves(world).isEmpty()
                && finished(world).size() < wiring.components().size();
    }

    /** The number of steps to the nearest world in which each component is in one of its states; empty if none is. */
    Optional<Integer> distance(Map<String, Set<String>> states) {
        var far = new LinkedHashMap<World, Integer>();
        far.put(start(), 0);
        var ahead = new ArrayDeque<>(far.keySet());
        while (!ahead.isEmpty()) {
            var world = ahead.remove();
            int here = requireNonNull(far.get(world));
            if (states.entrySet().stream()
                    .allMatch(entry -> in(requireNonNull(world.at().get(entry.getKey())))
                            .filter(entry.getValue()::contains)
                            .isPresent())) {
                return Optional.of(here);
            }
            for (var move : moves(world)) {
                if (far.putIfAbsent(move.next(), here + 1) == null) {
                    ahead.add(move.next());
                }
            }
        }
        return Optional.empty();
    }

    /** The state in which a component is until its step is over. */
    private static Optional<String> in(Status status) {
        return switch (status) {
            case Status.In(var state) -> Optional.of(state);
            case Status.Decided(var step) -> Optional.of(step.from());
            case Status.Waiting(var request) -> Optional.of(request.from());
            case Status.Served(var request) -> Optional.of(request.from());
            case Status.Accepted(var request) -> Optional.of(request.from());
            case Status.Serving serving -> Optional.of(serving.offer().from());
            case Status.Left(var state) -> Optional.of(state);
            case Status.Owing owing -> Optional.empty();
            case Status.Closing closing -> Optional.empty();
        };
    }

    // ---- components that end

    boolean someEnd() {
        return wiring.components().stream().anyMatch(this::mayEnd);
    }

    private boolean mayEnd(String component) {
        return wiring.protocol(component).steps(Step.Ends.class).findAny().isPresent();
    }

    /**
     * The components that have ended, and those that wait for a call while all that call them have ended; of those that
     * call each other, all or none.
     */
    Set<String> finished(World world) {
        var done = new TreeSet<String>();
        if (!someEnd()) {
            return done;
        }
        for (var component : wiring.components()) {
            if (world.at().get(component) instanceof Status.Left
                    || world.at().get(component) instanceof Status.In(var state)
                            && wiring.protocol(component).out(state).get(0) instanceof Step.Ends) {
                done.add(component);
            }
        }
        var isGrowing = true;
        while (isGrowing) {
            isGrowing = false;
            for (var component : wiring.components()) {
                var circle = circle(component);
                var callers = wiring.components().stream()
                        .filter(caller -> !circle.contains(caller))
                        .filter(caller -> circle.stream().anyMatch(each -> calls(caller, each)))
                        .toList();
                if (!callers.isEmpty()
                        && done.containsAll(callers)
                        && circle.stream().allMatch(each -> waitsForCall(world, each))) {
                    isGrowing |= done.addAll(circle);
                }
            }
        }
        return done;
    }

    /** A component that has finished and might fail may also be left, with those that it calls and that call it. */
    private Optional<Move> left(World world, String component) {
        if (!(world.at().get(component) instanceof Status.In(var state))
                || !wiring.protocol(component).failsIn(state)) {
            return Optional.empty();
        }
        var next = world.copy();
        for (var each : circle(component)) {
            if (next.at().get(each) instanceof Status.In(var here)) {
                next.at().put(each, new Status.Left(here));
            }
        }
        return Optional.of(new Move(null, true, circle(component), next));
    }

    private boolean calls(String caller, String provider) {
        return wiring.protocol(caller)
                .outgoing()
                .anyMatch(step -> wiring.provider(caller, step).equals(provider));
    }

    /** A component, and those that call it and that it calls, directly or not, if none of them ends. */
    private Set<String> circle(String component) {
        var circle = new TreeSet<>(Set.of(component));
        for (var other : wiring.components()) {
            if (leads(component, other, Set.of()) && leads(other, component, Set.of())) {
                circle.add(other);
            }
        }
        return circle;
    }

    private boolean leads(String from, String to, Set<String> past) {
        if (mayEnd(from) || mayEnd(to)) {
            return false;
        }
        var seen = new TreeSet<>(past);
        seen.add(from);
        return calls(from, to)
                || wiring.components().stream()
                        .anyMatch(next -> !seen.contains(next) && calls(from, next) && leads(next, to, seen));
    }

    private boolean waitsForCall(World world, String component) {
        if (!(world.at().get(component) instanceof Status.In(var state))
                || !requireNonNull(world.mail().get(component)).isEmpty()) {
            return false;
        }
        var protocol = wiring.protocol(component);
        var out = protocol.out(state);
        if (world.questions().keySet().stream().anyMatch(key -> key.startsWith(component + ">"))
                || protocol.failsIn(state) && !world.holds().get(component).isEmpty()) {
            return false;
        }
        return out.stream().anyMatch(Step.Incoming.class::isInstance)
                && out.stream().allMatch(step -> switch (step) {
                    case Step.Receives receives -> !wiring.isOpen(component + "." + receives.call());
                    case Step.Incoming offer -> !wiring.isOpen(component + "." + offer.call());
                    case Step.Takes takes -> true;
                    case Step.Stops stops -> wiring.stopsTogether();
                    default -> false;
                });
    }

    /**
     * The components that can come to wait for ever: from some world no way leads to a step of theirs, or their end.
     */
    Set<String> blocked() {
        var sources = new LinkedHashMap<World, List<World>>();
        worlds.forEach((world, moves) -> moves.forEach(move ->
                sources.computeIfAbsent(move.next(), key -> new ArrayList<>()).add(world)));
        var blocked = new TreeSet<String>();
        for (var component : wiring.components()) {
            var canMove = new HashSet<World>();
            worlds.forEach((world, moves) -> {
                if (moves.stream().anyMatch(move -> move.who().contains(component))
                        || finished(world).contains(component)) {
                    canMove.add(world);
                }
            });
            var ahead = new ArrayDeque<>(canMove);
            while (!ahead.isEmpty()) {
                sources.getOrDefault(ahead.remove(), List.of()).stream()
                        .filter(canMove::add)
                        .forEach(ahead::add);
            }
            if (canMove.size() < worlds.size()) {
                blocked.add(component);
            }
        }
        return blocked;
    }

    /** These worlds, and those that steps lead to which need not be seen. */
    Set<World> closed(Set<World> some, Set<String> observed) {
        var all = new LinkedHashSet<>(some);
        var ahead = new ArrayDeque<>(some);
        while (!ahead.isEmpty()) {
            for (var move : moves(ahead.remove())) {
                if (move.mayBeUnseen(observed) && all.add(move.next())) {
                    ahead.add(move.next());
                }
            }
        }
        return all;
    }

    /** The worlds after an event; none if it is not possible in any of {@code some}. */
    Set<World> after(Set<World> some, ProtocolEvent event, Set<String> observed) {
        var after = new LinkedHashSet<World>();
        for (var world : some) {
            moves(world).stream()
                    .filter(move -> move.seen(observed).equals(Optional.of(event)))
                    .map(Move::next)
                    .forEach(after::add);
            if (event.kind() == Kind.WAITS
                    && world.at().get(event.component()) instanceof Status.In(var state)
                    && onlyWay(event.component(), state)
                            .filter(step -> event.equals(
                                    new Interpreter(wiring, mayBeOpen, world).waits(event.component(), step)))
                            .isPresent()) {
                after.add(world);
            }
        }
        return closed(after, observed);
    }

    /** The step that a component has to take in a state, if it may have to wait. */
    private Optional<Step.Waiting> onlyWay(String component, String state) {
        var out = wiring.protocol(component).out(state);
        return out.size() == 1 && out.get(0) instanceof Step.Waiting step && !step.tries()
                ? Optional.of(step)
                : Optional.empty();
    }

    /** Whether something has been begun that is not over: by a component, for a question, or in a mailbox. */
    boolean isUnderWay(World world) {
        for (var entry : world.at().entrySet()) {
            var component = entry.getKey();
            if (entry.getValue() instanceof Status.Left) {
                continue;
            }
            if (!(entry.getValue() instanceof Status.In(var state))) {
                return true;
            }
            var only = onlyWay(component, state);
            if (only.isPresent()
                    && moves(world).stream()
                            .filter(move -> move.who().contains(component))
                            .allMatch(move -> requireNonNull(move.event()).kind() == Kind.FAILED)) {
                return true;
            }
        }
        var isAsked = world.questions().entrySet().stream()
                .anyMatch(entry -> entry.getValue() == Phase.ASKED
                        || entry.getValue() == Phase.ACCEPTED
                        || entry.getValue() == Phase.OPEN && !isStream(entry.getKey()));
        return isAsked || world.mail().values().stream().anyMatch(mail -> !mail.isEmpty());
    }

    private boolean isStream(String question) {
        var target = question.substring(question.indexOf('>') + 1);
        var dot = target.indexOf('.');
        return wiring.protocol(target.substring(0, dot)).isStream(target.substring(dot + 1));
    }

    /** The steps out of one world. */
    private static final class Interpreter {
        private final Wiring wiring;
        private final Map<String, Map<String, Set<String>>> mayBeOpen;
        private final World now;
        private final List<Move> moves = new ArrayList<>();
        private final Set<String> all;

        Interpreter(Wiring wiring, Map<String, Map<String, Set<String>>> mayBeOpen, World now) {
            this.wiring = wiring;
            this.mayBeOpen = mayBeOpen;
            this.now = now;
            all = Set.copyOf(wiring.components());
        }

        List<Move> moves() {
            now.at().forEach(this::component);
            for (var receiver : wiring.components()) {
                for (var message : wiring.protocol(receiver).received()) {
                    var box = wiring.mailbox(receiver).orElseThrow();
                    var isFull = now.mail().get(receiver).size() == box.capacity();
                    if (wiring.isOpen(receiver + "." + message)
                            && (!isFull || box.overflow() == Overflow.DROP_OLDEST)) {
                        var event = new ProtocolEvent(Kind.ARRIVED, receiver, message);
                        move(event, Set.of(), world -> deliver(world, receiver, message, box.capacity()));
                    }
                }
            }
            wiring.stopGroups().forEach(this::stopTogether);
            return moves;
        }

        private void stopTogether(Set<String> group) {
            var members = group.stream()
                    .filter(member -> !wiring.stops(member).isEmpty())
                    .toList();
            if (!members.isEmpty()
                    && members.stream()
                            .allMatch(member -> now.at().get(member) instanceof Status.In(var state)
                                    && wiring.stops(member).contains(state))) {
                move(
                        null,
                        Set.copyOf(members),
                        world -> members.forEach(member -> go(
                                world, member, wiring.protocol(member).states().get(0))));
            }
        }

        // ---- moves

        private void move(@Nullable ProtocolEvent event, Set<String> who, Consumer<World> change) {
            move(event, event == null, who, change);
        }

        private void move(@Nullable ProtocolEvent event, boolean mayBeUnseen, Set<String> who, Consumer<World> change) {
            var world = now.copy();
            change.accept(world);
            moves.add(new Move(event, mayBeUnseen, who, world));
        }

        private void move(Kind kind, String me, String what, Consumer<World> change) {
            move(new ProtocolEvent(kind, me, what), Set.of(me), change);
        }

        private static void go(World world, String component, String state) {
            world.at().put(component, new Status.In(state));
        }

        private static void deliver(World world, String receiver, String message, int capacity) {
            var mail = new ArrayList<>(world.mail().get(receiver));
            mail.add(message);
            world.mail().put(receiver, List.copyOf(mail.size() > capacity ? mail.subList(1, mail.size()) : mail));
        }

        // ---- components

        private void component(String me, Status status) {
            switch (status) {
                case Status.In(var state) -> {
                    requireKnown(me, state);
                    wiring.protocol(me).out(state).forEach(step -> out(me, step));
                    failing(me, state, world -> {});
                }
                case Status.Decided(var step) -> {
                    finish(me, step);
                    failing(me, step.from(), world -> {});
                }
                case Status.Waiting(var request) -> {
                    request.onTimeout()
                            .ifPresent(state -> move(
                                    Kind.TIMED_OUT, me, wiring.target(me, request), world -> go(world, me, state)));
                    failing(me, request.from(), world -> {});
                }
                case Status.Served(var request) -> {
                    var provider = wiring.provider(me, request);
                    request.onTimeout()
                            .ifPresent(state -> move(Kind.TIMED_OUT, me, provider + "." + request.call(), world -> {
                                go(world, me, state);
                                giveUp(world, provider);
                            }));
                    failing(me, request.from(), world -> giveUp(world, provider));
                }
                case Status.Accepted(var request) -> {
                    var key = me + ">" + wiring.target(me, request);
                    request.onTimeout()
                            .ifPresent(state -> move(Kind.TIMED_OUT, me, wiring.target(me, request), world -> {
                                go(world, me, state);
                                world.gone().merge(key, 1, Integer::sum);
                            }));
                    failing(me, request.from(), world -> world.gone().merge(key, 1, Integer::sum));
                }
                case Status.Serving serving -> serving(me, serving);
                case Status.Left left -> {}
                case Status.Owing(var calls) -> owing(me, calls);
                case Status.Closing(var number) -> close(me, number);
            }
        }

        /** No question is open where the declaration lets none be. */
        private void requireKnown(String me, String state) {
            for (var key : now.questions().keySet()) {
                if (key.startsWith(me + ">")
                        && !mayBeOpen.get(me).get(state).contains(key.substring(me.length() + 1))) {
                    throw new AssertionError("the question " + key + " is open in " + state);
                }
            }
        }

        private static void giveUp(World world, String provider) {
            var serving = (Status.Serving) world.at().get(provider);
            world.at()
                    .put(provider, new Status.Serving(serving.offer(), serving.caller(), For.NOBODY, serving.isDone()));
        }

        private void failing(String me, String state, Consumer<World> more) {
            wiring.protocol(me)
                    .failure()
                    .filter(down -> !down.equals(state))
                    .filter(down -> !(wiring.protocol(me).out(state).get(0) instanceof Step.Ends))
                    .ifPresent(down -> move(Kind.FAILED, me, "", world -> {
                        more.accept(world);
                        world.holds().put(me, List.of());
                        failed(world, me, wiring.protocol(me).owed(state));
                    }));
        }

        private void failed(World world, String me, List<String> owed) {
            if (!owed.isEmpty()) {
                world.at().put(me, new Status.Owing(owed));
            } else if (questions(me).isEmpty() && streams(me).isEmpty()) {
                go(world, me, wiring.protocol(me).failure().orElseThrow());
            } else {
                world.at().put(me, new Status.Closing(0));
            }
        }

        private void owing(String me, List<String> calls) {
            var rest = calls.subList(1, calls.size());
            for (var end : ends(me, calls.get(0), false)) {
                move(null, Set.of(me), end.change().andThen(world -> failed(world, me, rest)));
            }
        }

        /** One way in which an accepted call ends: for the caller that is answered. */
        private record End(String caller, boolean waits, boolean isGone, Consumer<World> change) {}

        private List<End> ends(String me, String call, boolean isAnswer) {
            var target = me + "." + call;
            var ends = new ArrayList<End>();
            if (wiring.callers(me, call, all).isEmpty()) {
                ends.add(new End("", false, false, world -> {}));
            }
            now.at().forEach((caller, status) -> {
                if (status instanceof Status.Accepted(var request)
                        && wiring.target(caller, request).equals(target)) {
                    var to = isAnswer ? request.to() : request.onRejection().orElse("");
                    ends.add(new End(caller, true, false, world -> go(world, caller, to)));
                }
            });
            now.questions().forEach((key, phase) -> {
                if (phase == Phase.ACCEPTED && key.endsWith(">" + target)) {
                    var after = isAnswer ? Phase.SETTLED : Phase.REJECTED;
                    ends.add(new End(
                            key.substring(0, key.indexOf('>')),
                            false,
                            false,
                            world -> world.questions().put(key, after)));
                }
            });
            now.gone().forEach((key, number) -> {
                if (key.endsWith(">" + target)) {
                    ends.add(new End(key.substring(0, key.indexOf('>')), false, true, world -> {
                        world.gone().remove(key);
                        if (number > 1) {
                            world.gone().put(key, number - 1);
                        }
                    }));
                }
            });
            return ends;
        }

        /** The end of an accepted call, which is owed: a caller is answered, or none waits any more. */
        private void end(String me, String call, Kind kind, Consumer<World> arrive) {
            var ends = ends(me, call, kind == Kind.ANSWERED);
            if (ends.isEmpty()) {
                throw new AssertionError(me + " owes no answer of " + call + " in " + now);
            }
            for (var end : ends) {
                var event = end.caller().isEmpty()
                        ? new ProtocolEvent(Kind.DID, me, (kind == Kind.ANSWERED ? "answers " : "refuses ") + call)
                        : new ProtocolEvent(kind, end.caller(), me + "." + call);
                var who = end.waits() ? Set.of(me, end.caller()) : Set.of(me);
                move(event, end.isGone(), who, end.change().andThen(arrive));
            }
        }

        private List<String> questions(String me) {
            return wiring.protocol(me)
                    .steps(Step.Asks.class)
                    .map(asks -> wiring.target(me, asks))
                    .distinct()
                    .toList();
        }

        /** The streams of a provider that others ask for. */
        private List<String> streams(String me) {
            return wiring.components().stream()
                    .flatMap(caller -> questions(caller).stream())
                    .filter(target -> target.startsWith(me + "."))
                    .map(target -> target.substring(me.length() + 1))
                    .filter(call -> wiring.protocol(me).isStream(call))
                    .distinct()
                    .toList();
        }

        private void serving(String me, Status.Serving serving) {
            var offer = serving.offer();
            var caller = serving.caller();
            var target = me + "." + offer.call();
            var key = caller + ">" + target;
            var who = serving.what() == For.REQUEST ? Set.of(me, caller) : Set.of(me);
            if (!serving.isDone()) {
                move(
                        null,
                        Set.of(me),
                        world -> world.at().put(me, new Status.Serving(offer, caller, serving.what(), true)));
            } else {
                var event = new ProtocolEvent(Kind.ANSWERED, caller, target);
                move(event, serving.what() == For.NOBODY, who, world -> {
                    go(world, me, offer.to());
                    switch (serving.what()) {
                        case REQUEST -> go(world, caller, served(caller).to());
                        case QUESTION -> world.questions().put(key, Phase.SETTLED);
                        case NOBODY -> {}
                    }
                });
            }
            failing(me, offer.from(), world -> {
                switch (serving.what()) {
                    case REQUEST ->
                        go(world, caller, served(caller).onRejection().orElseThrow());
                    case QUESTION -> world.questions().put(key, Phase.REJECTED);
                    case NOBODY -> {}
                }
            });
        }

        private Step.Requests served(String caller) {
            return ((Status.Served) now.at().get(caller)).request();
        }

        private void close(String me, int number) {
            var questions = questions(me);
            var streams = streams(me);
            move(null, Set.of(me), world -> {
                if (number < questions.size()) {
                    cancel(world, me, questions.get(number));
                } else {
                    subscriber(me, streams.get(number - questions.size()))
                            .ifPresent(key -> world.questions().put(key, Phase.REJECTED));
                }
                if (number + 1 < questions.size() + streams.size()) {
                    world.at().put(me, new Status.Closing(number + 1));
                } else {
                    go(world, me, wiring.protocol(me).failure().orElseThrow());
                }
            });
        }

        private void cancel(World world, String me, String target) {
            var provider = target.substring(0, target.indexOf('.'));
            var call = target.substring(target.indexOf('.') + 1);
            var phase = world.questions().remove(me + ">" + target);
            world.items().remove(me + ">" + target);
            if (phase == Phase.OPEN && !wiring.protocol(provider).isStream(call)) {
                giveUp(world, provider);
            }
            if (phase == Phase.ACCEPTED) {
                world.gone().merge(me + ">" + target, 1, Integer::sum);
            }
        }

        /** The question that is an open stream of a call. */
        private Optional<String> subscriber(String provider, String call) {
            return now.questions().entrySet().stream()
                    .filter(entry -> entry.getKey().endsWith(">" + provider + "." + call))
                    .filter(entry -> entry.getValue() == Phase.OPEN)
                    .map(Map.Entry::getKey)
                    .findFirst();
        }

        // ---- steps

        private void out(String me, Step step) {
            Consumer<World> arrive = world -> go(world, me, step.to());
            switch (step) {
                case Step.Does does -> move(Kind.DID, me, does.label(), arrive);
                case Step.Ends ends -> {}
                case Step.Stops stops -> {
                    if (!wiring.stopsTogether()) {
                        move(null, Set.of(me), arrive);
                    }
                }
                case Step.Requests request ->
                    move(
                            Kind.ASKED,
                            me,
                            wiring.target(me, request),
                            world -> world.at().put(me, new Status.Waiting(request)));
                case Step.Waiting waiting -> {
                    if (staysWith(me, waiting)) {
                        move(
                                waits(me, waiting),
                                true,
                                Set.of(me),
                                world -> world.at().put(me, new Status.Decided(waiting)));
                    } else {
                        finish(me, waiting);
                    }
                }
                case Step.Releases releases -> {
                    var resource = wiring.bound(me, releases.resource());
                    move(Kind.RELEASED, me, resource, arrive.andThen(world -> hold(world, me, resource, false)));
                }
                case Step.Receives receives -> {
                    var mail = now.mail().get(me);
                    if (!mail.isEmpty() && mail.get(0).equals(receives.call())) {
                        move(
                                Kind.RECEIVED,
                                me,
                                receives.call(),
                                arrive.andThen(world ->
                                        world.mail().put(me, List.copyOf(mail.subList(1, mail.size())))));
                    }
                }
                case Step.Answers answers -> end(me, answers.call(), Kind.ANSWERED, arrive);
                case Step.Refuses refuses -> end(me, refuses.call(), Kind.REJECTED, arrive);
                case Step.Incoming offer -> offer(me, offer, arrive);
                case Step.Cancels cancels -> {
                    var target = wiring.target(me, cancels);
                    move(Kind.GAVE_UP, me, target, arrive.andThen(world -> cancel(world, me, target)));
                }
                case Step.Takes takes -> take(me, takes, arrive);
                case Step.Finishes finishes ->
                    move(
                            Kind.FINISHED,
                            me,
                            finishes.call(),
                            arrive.andThen(world -> subscriber(me, finishes.call())
                                    .ifPresent(key -> world.questions().put(key, Phase.SETTLED))));
            }
        }

        /** Whether a component chooses this step before it takes it. */
        private boolean staysWith(String me, Step.Waiting step) {
            if (step.tries() || wiring.protocol(me).out(step.from()).size() < 2) {
                return false;
            }
            return switch (step) {
                case Step.Acquires acquires -> true;
                case Step.Emits emits -> !wiring.callers(me, emits.call(), all).isEmpty();
                case Step.Asks asks -> mayBeOpen.get(me).get(asks.from()).contains(wiring.target(me, asks));
                case Step.Sends sends ->
                    wiring.mailbox(wiring.provider(me, sends)).orElseThrow().overflow() == Overflow.BLOCK;
            };
        }

        ProtocolEvent waits(String me, Step.Waiting step) {
            return new ProtocolEvent(
                    Kind.WAITS,
                    me,
                    switch (step) {
                        case Step.Acquires acquires -> wiring.bound(me, acquires.resource());
                        case Step.Emits emits -> emits.call();
                        case Step.Asks asks -> wiring.target(me, asks);
                        case Step.Sends sends -> wiring.target(me, sends);
                    });
        }

        /** Takes a step that may have to wait, if it has not to wait. */
        private void finish(String me, Step.Waiting step) {
            Consumer<World> arrive = world -> go(world, me, step.to());
            switch (step) {
                case Step.Acquires acquires -> {
                    var resource = wiring.bound(me, acquires.resource());
                    var held = now.holds().values().stream()
                            .flatMap(List::stream)
                            .filter(resource::equals)
                            .count();
                    if (held < wiring.resources().get(resource)) {
                        move(Kind.ACQUIRED, me, resource, arrive.andThen(world -> hold(world, me, resource, true)));
                    }
                }
                case Step.Sends sends -> send(me, sends, arrive);
                case Step.Asks asks -> {
                    var target = wiring.target(me, asks);
                    var key = me + ">" + target;
                    if (!now.questions().containsKey(key)) {
                        move(
                                Kind.ASKED,
                                me,
                                target,
                                arrive.andThen(world -> world.questions().put(key, Phase.ASKED)));
                    }
                }
                case Step.Emits emits -> {
                    var key = subscriber(me, emits.call());
                    if (key.isEmpty()) {
                        move(Kind.EMITTED, me, emits.call(), arrive);
                    } else if (now.items().getOrDefault(key.get(), 0) < wiring.window(me, emits.call())) {
                        move(
                                Kind.EMITTED,
                                me,
                                emits.call(),
                                arrive.andThen(world -> world.items().merge(key.get(), 1, Integer::sum)));
                    }
                }
            }
        }

        private static void hold(World world, String me, String resource, boolean isTaken) {
            var held = new ArrayList<>(world.holds().get(me));
            if (isTaken) {
                held.add(resource);
            } else {
                held.remove(resource);
            }
            world.holds().put(me, held.stream().sorted().toList());
        }

        private void send(String me, Step.Sends sends, Consumer<World> arrive) {
            var receiver = wiring.provider(me, sends);
            var target = receiver + "." + sends.call();
            var box = wiring.mailbox(receiver).orElseThrow();
            var isFull = now.mail().get(receiver).size() == box.capacity();
            if (!isFull || box.overflow() == Overflow.DROP_OLDEST) {
                move(
                        Kind.SENT,
                        me,
                        target,
                        arrive.andThen(world -> deliver(world, receiver, sends.call(), box.capacity())));
            } else if (box.overflow() == Overflow.REJECT) {
                move(
                        Kind.REFUSED,
                        me,
                        target,
                        world -> go(world, me, sends.onRejection().orElse(sends.to())));
            }
        }

        private void take(String me, Step.Takes takes, Consumer<World> arrive) {
            var target = wiring.target(me, takes);
            var key = me + ">" + target;
            var phase = now.questions().get(key);
            var items = now.items().getOrDefault(key, 0);
            if (takes.outcome() == Outcome.ANSWER
                    && wiring.protocol(wiring.provider(me, takes)).isStream(takes.call())) {
                if (items > 0) {
                    move(Kind.GOT_ANSWER, me, target, arrive.andThen(world -> {
                        world.items().remove(key);
                        if (items > 1) {
                            world.items().put(key, items - 1);
                        }
                    }));
                }
                return;
            }
            var wanted = takes.outcome() == Outcome.REJECTION ? Phase.REJECTED : Phase.SETTLED;
            var kind = switch (takes.outcome()) {
                case ANSWER -> Kind.GOT_ANSWER;
                case REJECTION -> Kind.GOT_REJECTION;
                case END -> Kind.GOT_END;
            };
            if (phase == wanted && items == 0) {
                move(kind, me, target, arrive.andThen(world -> world.questions().remove(key)));
            }
        }

        private void offer(String me, Step.Incoming offer, Consumer<World> arrive) {
            var target = me + "." + offer.call();
            if (wiring.callers(me, offer.call(), all).isEmpty()) {
                move(Kind.DID, me, offer.call(), arrive);
                return;
            }
            now.at().forEach((caller, status) -> {
                if (status instanceof Status.Waiting(var request)
                        && wiring.target(caller, request).equals(target)) {
                    take(me, offer, caller, request, arrive);
                }
            });
            now.questions().forEach((key, phase) -> {
                if (phase == Phase.ASKED && key.endsWith(">" + target)) {
                    take(me, offer, key, arrive);
                }
            });
        }

        /** Takes a request. */
        private void take(
                String me, Step.Incoming offer, String caller, Step.Requests request, Consumer<World> arrive) {
            var target = me + "." + offer.call();
            var both = Set.of(me, caller);
            switch (offer) {
                case Step.Provides provides ->
                    move(new ProtocolEvent(Kind.TAKEN, caller, target), both, world -> {
                        world.at().put(caller, new Status.Served(request));
                        world.at().put(me, new Status.Serving(provides, caller, For.REQUEST, false));
                    });
                case Step.Accepts accepts ->
                    move(
                            new ProtocolEvent(Kind.TAKEN, caller, target),
                            both,
                            arrive.andThen(world -> world.at().put(caller, new Status.Accepted(request))));
                case Step.Rejects rejects ->
                    move(
                            new ProtocolEvent(Kind.REJECTED, caller, target),
                            both,
                            arrive.andThen(world ->
                                    go(world, caller, request.onRejection().orElseThrow())));
                default -> throw new AssertionError(offer + " of a request");
            }
        }

        /** Takes a question. */
        private void take(String me, Step.Incoming offer, String key, Consumer<World> arrive) {
            var caller = key.substring(0, key.indexOf('>'));
            var target = me + "." + offer.call();
            var taken = new ProtocolEvent(Kind.TAKEN, caller, target);
            switch (offer) {
                case Step.Provides provides ->
                    move(taken, Set.of(me), world -> {
                        world.questions().put(key, Phase.OPEN);
                        world.at().put(me, new Status.Serving(provides, caller, For.QUESTION, false));
                    });
                case Step.Accepts accepts ->
                    move(
                            taken,
                            Set.of(me),
                            arrive.andThen(world -> world.questions().put(key, Phase.ACCEPTED)));
                case Step.Streams streams -> {
                    if (subscriber(me, streams.call()).isEmpty()) {
                        move(
                                taken,
                                Set.of(me),
                                arrive.andThen(world -> world.questions().put(key, Phase.OPEN)));
                    }
                }
                default ->
                    move(
                            new ProtocolEvent(Kind.REJECTED, caller, target),
                            Set.of(me),
                            arrive.andThen(world -> world.questions().put(key, Phase.REJECTED)));
            }
        }
    }
}
