package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/**
 * The protocols of recorded runs.
 *
 * <p>Each run is read once for each component, as the list of the steps that this component took. A state is what it
 * has under way after a step: its {@link Activity activities}, which are the calls that it serves, and the questions
 * that belong to none of them. Equal situations are one state, so what followed one of them may follow each.
 *
 * <p>Which activity a step belongs to is known from the call that was served when it was made; a call of the component
 * itself is part of the activity that makes it.
 */
final class RecordedProtocols {
    static final String FIRST = "idle";

    /** What was observed, in order. */
    sealed interface Fact {
        /**
         * @param caller empty for one that is no actor
         * @param served the number of the call that the caller serves, or -1
         */
        record Called(int number, String caller, String callee, String method, boolean isRequest, int served)
                implements Fact {
            String target() {
                return callee + "." + method;
            }

            boolean isOfItself() {
                return caller.equals(callee);
            }

            boolean isBetweenActors() {
                return !caller.isEmpty() && !isOfItself();
            }
        }

        record Begun(int number) implements Fact {}

        /** @param isGivenUp settled by its caller, or by a time limit */
        record Settled(int number, boolean isGivenUp) implements Fact {}

        record Held(String component, boolean isHeld) implements Fact {}
    }

    /** A way out of a state. */
    record Edge(String verb, String what, String to) {}

    /** A component: its ways out by state, in the order in which the states were seen. */
    static final class Component {
        final String name;
        final @Nullable Class<?> type;
        final Map<String, Set<Edge>> states = new LinkedHashMap<>();
        final Map<String, Situation> situations = new HashMap<>();
        final Map<String, Boolean> isAlwaysAtOnce = new TreeMap<>(); // by method that other components call

        Component(String name, @Nullable Class<?> type) {
            this.name = name;
            this.type = type;
            states.put(FIRST, new LinkedHashSet<>());
        }

        void edge(String from, String verb, String what, String to) {
            states.computeIfAbsent(to, each -> new LinkedHashSet<>());
            requireNonNull(states.get(from)).add(new Edge(verb, what, to));
        }

        Stream<Edge> edges(String verb) {
            return states.values().stream()
                    .flatMap(Set::stream)
                    .filter(edge -> edge.verb().equals(verb));
        }
    }

    /** A call that is served, or a message that is followed up: what it did last, and which questions are open. */
    record Activity(String method, String last, List<String> open, boolean isAnswered) {
        String words() {
            return (method
                            + (isAnswered ? " answered" : "")
                            + (last.isEmpty() ? "" : " after " + last)
                            + (open.isEmpty() ? "" : " waits for " + String.join(" and ", open)))
                    .strip();
        }

        Activity asking(List<String> next) {
            return new Activity(method, last, next, isAnswered);
        }
    }

    /** What a component has under way; the activity -1 holds the questions that belong to none. */
    record Situation(Map<Integer, Activity> activities, boolean isHolding) {
        Situation with(int number, @Nullable Activity next) {
            var all = new TreeMap<>(activities);
            if (next == null || number < 0 && next.open().isEmpty()) {
                all.remove(number);
            } else {
                all.put(number, next);
            }
            return new Situation(all, isHolding);
        }

        Situation holding(boolean next) {
            return new Situation(activities, next);
        }

        String name() {
            String words =
                    activities.values().stream().map(Activity::words).sorted().collect(Collectors.joining("; "));
            return (words.isEmpty() ? FIRST : words) + (isHolding ? ", holding its calls" : "");
        }

        /** Without an open question; null if that is not open. */
        @Nullable
        Situation without(String target) {
            return activities.entrySet().stream()
                    .filter(each -> each.getValue().open().contains(target))
                    .findFirst()
                    .map(each -> with(each.getKey(), after(each.getValue(), target)))
                    .orElse(null);
        }

        static Activity after(Activity activity, String target) {
            var open = new ArrayList<>(activity.open());
            open.remove(target);
            return new Activity(
                    activity.method(), activity.method().isEmpty() ? "" : target, open, activity.isAnswered());
        }
    }

    private final String name;
    private final List<List<Fact>> runs;
    private final Map<String, Class<?>> types;
    private final Map<String, Component> components = new TreeMap<>();
    private final Map<String, Integer> mailboxes = new TreeMap<>();
    private final Set<String> activeFromOutside = new LinkedHashSet<>(); // methods that call others, with the component
    private final Set<String> problems = new LinkedHashSet<>();

    /** @param types of the components whose calls are all methods of one type */
    RecordedProtocols(String name, List<List<Fact>> runs, Map<String, Class<?>> types, Set<String> streams) {
        this.name = name;
        this.runs = runs;
        this.types = types;
        streams.stream()
                .sorted()
                .forEach(target -> problems.add("the results of " + target
                        + " are not in the wiring: its caller goes on with its answer, or at once"));
        runs.forEach(run -> run.forEach(fact -> {
            if (fact instanceof Fact.Called called && called.isBetweenActors()) {
                component(called.caller());
                component(called.callee());
            }
        }));
        var all = runs.stream().map(Run::new).toList();
        all.forEach(run -> run.noteOutside(activeFromOutside));
        all.forEach(Run::read);
        components.values().forEach(this::complete);
        components.values().forEach(RecordedProtocols::shorten);
        components.values().forEach(RecordedProtocols::makeUnique);
    }

    private Component component(String component) {
        return components.computeIfAbsent(component, each -> new Component(each, types.get(each)));
    }

    String name() {
        return name;
    }

    List<Component> components() {
        return List.copyOf(components.values());
    }

    Map<String, Integer> mailboxes() {
        return mailboxes;
    }

    List<String> problems() {
        return List.copyOf(problems);
    }

    Wiring wiring() {
        var wiring = Wiring.of(name);
        for (var component : components.values()) {
            var protocol =
                    component.type == null ? Protocol.of(component.name) : Protocol.of(component.name, component.type);
            component.states.forEach((state, edges) -> protocol.state(
                    state,
                    edges.stream()
                            .map(edge -> Branch.of(edge.verb(), edge.what(), edge.to()))
                            .toArray(Branch[]::new)));
            wiring.component(component.name, protocol.build());
        }
        mailboxes.forEach((component, capacity) -> wiring.mailbox(component, capacity, Overflow.BLOCK));
        return wiring.build();
    }

    // ---- reading runs

    /** A step of a component, as the verb of its declaration. */
    private record Step(String verb, String what, int activity, Fact.Called call, int at, boolean isHoldingAfter) {}

    /** One run. */
    private final class Run {
        private final List<Fact> facts;
        private final Map<Integer, Fact.Called> calls = new HashMap<>();
        private final Set<Integer> begun;
        private final Set<Integer> settled;
        private final Map<Integer, Integer> ends = new HashMap<>(); // of activities: the number of the last fact

        Run(List<Fact> facts) {
            this.facts = facts;
            facts.forEach(fact -> {
                if (fact instanceof Fact.Called called) {
                    calls.put(called.number(), called);
                }
            });
            begun = facts.stream()
                    .filter(Fact.Begun.class::isInstance)
                    .map(fact -> ((Fact.Begun) fact).number())
                    .collect(Collectors.toSet());
            settled = facts.stream()
                    .filter(Fact.Settled.class::isInstance)
                    .map(fact -> ((Fact.Settled) fact).number())
                    .collect(Collectors.toSet());
            for (int at = 0; at < facts.size(); at++) {
                noteEnd(facts.get(at), at);
            }
        }

        private Fact.Called call(int number) {
            return requireNonNull(calls.get(number), () -> "no call " + number);
        }

        private void noteEnd(Fact fact, int at) {
            switch (fact) {
                case Fact.Called called -> ends.put(activityOf(called), at);
                case Fact.Begun(int number) -> ends.put(root(number), at);
                case Fact.Settled(int number, boolean isGivenUp) -> {
                    ends.put(root(number), at);
                    ends.put(activityOf(call(number)), at);
                }
                case Fact.Held held -> {}
            }
        }

        /** The activity of the caller in which a call is made, or -1. */
        private int activityOf(Fact.Called made) {
            int served = made.served();
            return served >= 0
                            && calls.containsKey(served)
                            && call(served).callee().equals(made.caller())
                    ? root(served)
                    : -1;
        }

        /** The activity that a call is, or the one that it is part of. */
        private int root(int number) {
            var call = call(number);
            return call.isOfItself() ? activityOf(call) : number;
        }

        /** Finds the calls from outside that do something: of others nothing is seen. */
        void noteOutside(Set<String> active) {
            calls.values().stream()
                    .filter(Fact.Called::isBetweenActors)
                    .map(this::activityOf)
                    .filter(number -> number >= 0 && call(number).caller().isEmpty())
                    .forEach(number -> active.add(call(number).target()));
        }

        private boolean isSeen(Fact.Called call) {
            return !call.caller().isEmpty() || activeFromOutside.contains(call.target());
        }

        void read() {
            components.values().forEach(this::read);
            noteMailboxes();
        }

        private void read(Component component) {
            var steps = new ArrayList<Step>();
            boolean isHolding = false;
            for (int at = 0; at < facts.size(); at++) {
                if (facts.get(at) instanceof Fact.Held held && held.component().equals(component.name)) {
                    isHolding = held.isHeld();
                    if (!steps.isEmpty()) {
                        steps.add(holding(steps.removeLast(), isHolding));
                    }
                } else {
                    step(component, at, steps, isHolding);
                }
            }
            replay(component, steps);
        }

        private static Step holding(Step step, boolean isHolding) {
            return new Step(step.verb(), step.what(), step.activity(), step.call(), step.at(), isHolding);
        }

        private void step(Component component, int at, List<Step> steps, boolean isHolding) {
            switch (facts.get(at)) {
                case Fact.Called made -> {
                    if (made.isBetweenActors() && made.caller().equals(component.name)) {
                        String verb = made.isRequest() ? "asks" : "sends";
                        steps.add(new Step(verb, made.target(), activityOf(made), made, at, isHolding));
                    }
                }
                case Fact.Begun(int number) -> {
                    var call = call(number);
                    if (call.callee().equals(component.name) && !call.isOfItself() && isSeen(call)) {
                        String verb = call.isRequest() ? "accepts" : "receives";
                        steps.add(new Step(verb, call.method(), number, call, at, isHolding));
                    }
                }
                case Fact.Settled(int number, boolean isGivenUp) -> {
                    var call = call(number);
                    if (call.callee().equals(component.name) && !call.isOfItself() && isSeen(call)) {
                        String verb = begun.contains(number) ? "answers" : isGivenUp ? "" : "rejects";
                        steps.add(new Step(verb, call.method(), number, call, at, isHolding));
                    }
                    if (call.isBetweenActors() && call.caller().equals(component.name)) {
                        String verb = isGivenUp ? "cancels" : begun.contains(number) ? "answered" : "rejected";
                        steps.add(new Step(verb, call.target(), activityOf(call), call, at, isHolding));
                    }
                }
                case Fact.Held held -> {}
            }
        }

        private void replay(Component component, List<Step> steps) {
            var now = new Situation(Map.of(), false);
            for (int at = 0; at < steps.size(); at++) {
                var step = steps.get(at);
                if (step.verb().isEmpty()) {
                    continue;
                }
                boolean isAtOnce = at + 1 < steps.size()
                        && step.verb().equals("accepts")
                        && !step.call().caller().isEmpty()
                        && steps.get(at + 1).verb().equals("answers")
                        && steps.get(at + 1).call() == step.call()
                        && isLast(steps.get(at + 1));
                if (isAtOnce) {
                    now = atOnce(component, now, step, steps.get(at + 1).isHoldingAfter());
                    at++;
                } else {
                    now = after(component, now, step);
                }
            }
            close(component, now);
        }

        /** Whether the activity of a step does nothing after it. */
        private boolean isLast(Step step) {
            return requireNonNull(ends.get(step.activity())) == step.at();
        }

        private Situation atOnce(Component component, Situation before, Step step, boolean isHolding) {
            var after = before.holding(isHolding);
            component.isAlwaysAtOnce.putIfAbsent(step.what(), true);
            move(component, before, "provides", step.what(), after);
            return after;
        }

        private Situation after(Component component, Situation before, Step step) {
            boolean isOutside = step.call().caller().isEmpty();
            int number = step.activity();
            var activity = before.activities().getOrDefault(number, new Activity("", "", List.of(), false));
            Situation next = switch (step.verb()) {
                case "accepts" -> {
                    if (!isOutside) {
                        component.isAlwaysAtOnce.put(step.what(), false);
                    }
                    yield before.with(number, new Activity(step.what(), "", List.of(), false));
                }
                case "receives" -> receives(component, before, step);
                case "answers" ->
                    before.with(
                            number,
                            isLast(step)
                                    ? null
                                    : new Activity(activity.method(), activity.last(), activity.open(), true));
                case "asks" -> asks(component, before, step, activity);
                case "sends" -> acts(before, step, activity.open());
                case "rejects" -> before;
                default ->
                    acts(before, step, Situation.after(activity, step.what()).open());
            };
            next = next.holding(step.isHoldingAfter());
            if (isOutside) {
                String label = step.verb().equals("answers")
                        ? WiringObserver.ANSWERS + step.what()
                        : step.what() + WiringObserver.FROM_OUTSIDE;
                move(component, before, "does", label, next);
            } else {
                move(component, before, step.verb(), step.what(), next);
            }
            return next;
        }

        private Situation receives(Component component, Situation before, Step step) {
            int number = step.activity();
            boolean isAll = isLast(step);
            if (!step.call().caller().isEmpty()) {
                component.isAlwaysAtOnce.merge(step.what(), isAll, Boolean::logicalAnd);
            }
            return isAll ? before : before.with(number, new Activity(step.what(), "", List.of(), false));
        }

        private Situation asks(Component component, Situation before, Step step, Activity activity) {
            boolean isOpen = before.activities().values().stream()
                    .anyMatch(each -> each.open().contains(step.what()));
            if (isOpen) {
                problems.add(component.name + " asks " + step.what()
                        + " while an earlier one of it is open, which a protocol cannot express; a translation can give each"
                        + " its own component");
            }
            var open = Stream.concat(activity.open().stream(), Stream.of(step.what()))
                    .sorted()
                    .toList();
            return before.with(step.activity(), activity.asking(open));
        }

        /** What an activity does or gets; the last of a message ends it. */
        private Situation acts(Situation before, Step step, List<String> open) {
            int number = step.activity();
            var activity = before.activities().get(number);
            if (activity == null) {
                return before;
            }
            boolean isAnswered = number >= 0 && (!call(number).isRequest() || activity.isAnswered());
            return before.with(
                    number,
                    isAnswered && isLast(step)
                            ? null
                            : new Activity(
                                    activity.method(), number < 0 ? "" : step.what(), open, activity.isAnswered()));
        }

        private void move(Component component, Situation before, String verb, String what, Situation after) {
            component.situations.putIfAbsent(before.name(), before);
            component.situations.putIfAbsent(after.name(), after);
            component.edge(before.name(), verb, what, after.name());
        }

        /** What is open at the end of a run is closed as if it were answered, and reported. */
        private void close(Component component, Situation last) {
            var now = last;
            for (var each : last.activities().entrySet()) {
                var activity = each.getValue();
                for (var target : activity.open()) {
                    var next = requireNonNull(now.without(target));
                    move(component, now, "answered", target, next);
                    now = next;
                }
                int number = each.getKey();
                if (number >= 0) {
                    var call = call(number);
                    var next = now.with(number, null);
                    boolean isOwed = call.isRequest() && !settled.contains(number);
                    boolean isOutside = call.caller().isEmpty();
                    move(
                            component,
                            now,
                            isOwed && !isOutside ? "answers" : "does",
                            isOwed
                                    ? (isOutside ? WiringObserver.ANSWERS : "") + call.method()
                                    : "end " + activity.method(),
                            next);
                    now = next;
                    if (isOwed) {
                        problems.add(component.name + " has not answered " + call.method()
                                + (isOutside ? " from outside" : " of " + call.caller()) + " when the run ended");
                    }
                }
            }
            if (!now.name().equals(FIRST) && now.activities().isEmpty()) {
                move(component, now, "does", "take calls again", now.holding(false));
            }
        }

        private void noteMailboxes() {
            var waiting = new HashMap<String, Integer>();
            for (var fact : facts) {
                if (fact instanceof Fact.Called called && called.isBetweenActors() && !called.isRequest()) {
                    int now = waiting.merge(called.callee(), 1, Integer::sum);
                    mailboxes.merge(called.callee(), now, Math::max);
                } else if (fact instanceof Fact.Begun(int number)
                        && call(number).isBetweenActors()
                        && !call(number).isRequest()) {
                    waiting.merge(call(number).callee(), -1, Integer::sum);
                }
            }
            calls.values().stream()
                    .filter(call -> call.isBetweenActors() && !begun.contains(call.number()))
                    .forEach(this::notBegun);
        }

        /** A call that was never begun is declared as one that would be. */
        private void notBegun(Fact.Called call) {
            var component = component(call.callee());
            if (!call.isRequest() || !settled.contains(call.number())) { // neither rejected nor given up
                problems.add(call.callee() + " has not begun " + call.method() + " of " + call.caller()
                        + " when the run ended");
            }
            boolean isOffered = Stream.of("provides", "accepts", "receives")
                    .flatMap(component::edges)
                    .anyMatch(edge -> edge.what().equals(call.method()));
            if (!isOffered) {
                component.edge(FIRST, call.isRequest() ? "provides" : "receives", call.method(), FIRST);
            }
        }
    }

    // ---- what follows from all runs

    /** Adds what actors do in each state: take the calls that they answer at once, and rejections. */
    private void complete(Component component) {
        var atOnce = component.isAlwaysAtOnce.entrySet().stream()
                .filter(Map.Entry::getValue)
                .map(Map.Entry::getKey)
                .toList();
        for (var state : List.copyOf(component.states.keySet())) {
            var situation = component.situations.get(state);
            if (situation != null && !situation.isHolding()) {
                atOnce.forEach(method -> component.edge(state, verbOf(component, method), method, state));
            }
        }
        components.values().stream()
                .flatMap(other -> other.edges("rejects").map(edge -> other.name + "." + edge.what()))
                .distinct()
                .forEach(target -> take(component, "rejected", target));
        component
                .edges("asks")
                .map(Edge::what)
                .distinct()
                .filter(target -> component
                        .edges("answered")
                        .noneMatch(edge -> edge.what().equals(target)))
                .toList()
                .forEach(target -> take(component, "answered", target));
        int messages =
                (int) component.edges("receives").map(Edge::what).distinct().count();
        mailboxes.computeIfPresent(component.name, (box, most) -> {
            int capacity = most;
            while (capacity > 1 && Mailboxes.contents(capacity, messages) > Mailboxes.MAX_CONTENTS) {
                capacity--;
            }
            if (capacity < most) {
                problems.add("the mailbox of " + box + " held " + most + " messages; declared are " + capacity
                        + ", which is the most for " + messages + " kinds of messages");
            }
            return capacity;
        });
    }

    private static String verbOf(Component component, String method) {
        return component.edges("receives").anyMatch(edge -> edge.what().equals(method)) ? "receives" : "provides";
    }

    /** Lets a component take what may come back for a question, wherever that is open. */
    private static void take(Component component, String outcome, String target) {
        for (var state : List.copyOf(component.states.keySet())) {
            var situation = component.situations.get(state);
            var next = situation == null ? null : situation.without(target);
            if (next != null) {
                component.situations.putIfAbsent(next.name(), next);
                boolean isNew = !component.states.containsKey(next.name());
                component.edge(state, outcome, target, next.name());
                if (isNew) {
                    component.edge(next.name(), "does", "go on after " + target + " was " + outcome, FIRST);
                }
            }
        }
    }

    /** A question whose caller does nothing until it is answered is a request. */
    private static void shorten(Component component) {
        component.edges("asks").map(Edge::what).distinct().toList().forEach(target -> {
            var waiting = component
                    .edges("asks")
                    .filter(edge -> edge.what().equals(target))
                    .map(Edge::to)
                    .collect(Collectors.toSet());
            boolean isRequest = waiting.stream().allMatch(state -> isOnlyAnswered(component, state, target));
            if (isRequest) {
                for (var state : List.copyOf(component.states.keySet())) {
                    var edges = requireNonNull(component.states.get(state)).stream()
                            .map(edge ->
                                    edge.verb().equals("asks") && edge.what().equals(target)
                                            ? new Edge("requests", target, next(component, edge.to()))
                                            : edge)
                            .collect(Collectors.toCollection(LinkedHashSet::new));
                    component.states.put(state, edges);
                }
                component.states.keySet().removeAll(waiting);
            }
        });
    }

    private static boolean isOnlyAnswered(Component component, String state, String target) {
        var out = requireNonNull(component.states.get(state));
        boolean isOnlyAsked = component.states.values().stream()
                .flatMap(Set::stream)
                .filter(edge -> edge.to().equals(state))
                .allMatch(edge -> edge.verb().equals("asks") && edge.what().equals(target));
        return isOnlyAsked
                && out.size() == 1
                && out.iterator().next().verb().equals("answered")
                && out.iterator().next().what().equals(target)
                && !out.iterator().next().to().equals(state);
    }

    private static String next(Component component, String state) {
        return requireNonNull(component.states.get(state)).iterator().next().to();
    }

    /** Equal ways out that lead to several states lead to one, from which private steps lead on. */
    private static void makeUnique(Component component) {
        for (var state : List.copyOf(component.states.keySet())) {
            var edges = requireNonNull(component.states.get(state));
            var byWords = edges.stream()
                    .collect(Collectors.groupingBy(
                            edge -> edge.verb() + " " + edge.what(), LinkedHashMap::new, Collectors.toList()));
            byWords.values().stream().filter(same -> same.size() > 1).forEach(same -> {
                String either = state + " then " + same.getFirst().what();
                same.forEach(edges::remove);
                edges.add(new Edge(same.getFirst().verb(), same.getFirst().what(), either));
                component.states.put(either, new LinkedHashSet<>());
                same.stream()
                        .sorted(Comparator.comparing(Edge::to))
                        .forEach(edge -> component.edge(either, "does", "go on as " + edge.to(), edge.to()));
            });
        }
    }
}
