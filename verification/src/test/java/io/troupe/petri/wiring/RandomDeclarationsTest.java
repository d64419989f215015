package io.troupe.petri.wiring;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.wiring.Step.Takes.Outcome;
import io.troupe.tools.Thorough;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;
import java.util.Set;
import java.util.TreeMap;
import java.util.function.Consumer;
import org.junit.jupiter.api.Test;

/** Random wirings of all kinds of steps: their nets have the states and steps of an interpreter that knows no net. */
class RandomDeclarationsTest {
    private static final int WIRINGS = Thorough.times(60, 300);
    private static final int MAX_WORLDS = 2_500;

    @Test
    void nets_ofRandomDeclarations_haveTheStatesAndStepsOfTheInterpreter() {
        var kinds = new HashMap<Class<?>, Integer>();
        var withDead = 0;
        var compared = 0;
        for (var seed = 0L; seed < WIRINGS; seed++) {
            var wiring = new RandomWiring(new Random(seed)).wiring("seed " + seed);
            var worlds = worlds(wiring);
            if (worlds.isEmpty()) {
                continue; // too many
            }
            compared++;
            var net = wiring.net();
            var graph = ReachabilityGraph.explore(net);
            var dead =
                    (int) worlds.values().stream().filter(steps -> steps == 0).count();
            var steps = worlds.values().stream().mapToInt(Integer::intValue).sum();
            assertThat(List.of(graph.size(), graph.edgeCount(), graph.dead().size()))
                    .as("states, steps and dead states of seed %d: %s", seed, describe(wiring))
                    .containsExactly(worlds.size(), steps, dead);
            assertThat(DeadlockSearch.run(net, SearchLimits.markings(graph.size()))
                            .deadlocks())
                    .as("dead states by stubborn sets of seed %d", seed)
                    .hasSize(dead);
            for (var component : wiring.components()) {
                wiring.protocol(component).steps().forEach(step -> kinds.merge(step.getClass(), 1, Integer::sum));
            }
            withDead += dead > 0 ? 1 : 0;
        }
        assertThat(kinds.keySet())
                .as("kinds of steps in the compared wirings")
                .containsExactlyInAnyOrder(
                        Step.Does.class,
                        Step.Requests.class,
                        Step.Provides.class,
                        Step.Rejects.class,
                        Step.Streams.class,
                        Step.Emits.class,
                        Step.Finishes.class,
                        Step.Asks.class,
                        Step.Takes.class,
                        Step.Cancels.class,
                        Step.Sends.class,
                        Step.Receives.class,
                        Step.Acquires.class,
                        Step.Releases.class,
                        Step.Stops.class);
        assertThat(kinds.values()).as("%s", kinds).allMatch(number -> number > Thorough.times(2, 20));
        assertThat(compared).isGreaterThan(Thorough.times(20, 100));
        assertThat(withDead).as("with a dead state").isBetween(Thorough.times(1, 10), compared - Thorough.times(1, 10));
    }

    private static String describe(Wiring wiring) {
        var text = new StringBuilder();
        for (var component : wiring.components()) {
            var protocol = wiring.protocol(component);
            text.append("\n").append(component).append(" fails to ").append(protocol.failure());
            protocol.steps().forEach(step -> text.append("\n  ").append(step));
            text.append("\n  ").append(wiring.mailbox(component));
        }
        return text.toString();
    }

    /** The number of steps out of each state that can be reached; empty if there are too many states. */
    private static Map<World, Integer> worlds(Wiring wiring) {
        var worlds = new LinkedHashMap<World, Integer>();
        var start = World.start(wiring);
        var ahead = new ArrayDeque<>(List.of(start));
        var seen = new HashSet<>(ahead);
        while (!ahead.isEmpty()) {
            if (seen.size() > MAX_WORLDS) {
                return Map.of();
            }
            var world = ahead.remove();
            var next = new Interpreter(wiring, world).next();
            worlds.put(world, next.size());
            next.stream().filter(seen::add).forEach(ahead::add);
        }
        return worlds;
    }

    // ---- the interpreter

    /** What a component does at the moment. */
    private sealed interface Status {
        record In(String state) implements Status {}

        record Waiting(Step.Requests request) implements Status {}

        record Served(Step.Requests request) implements Status {}

        /** Serves a call of {@code caller}, who has made a request, has asked a question, or has given up. */
        record Serving(Step.Provides offer, String caller, For what, boolean isDone) implements Status {}

        /** Has failed and closes its questions and streams; {@code number} of them are closed. */
        record Closing(int number) implements Status {}
    }

    private enum For {
        REQUEST,
        QUESTION,
        NOBODY
    }

    private enum Phase {
        ASKED,
        OPEN,
        SETTLED,
        REJECTED
    }

    private record World(
            Map<String, Status> at,
            Map<String, List<String>> mail,
            Map<String, List<String>> holds,
            Map<String, Phase> questions,
            Map<String, Integer> items) {
        static World start(Wiring wiring) {
            var world = new World(new TreeMap<>(), new TreeMap<>(), new TreeMap<>(), new TreeMap<>(), new TreeMap<>());
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
                    new TreeMap<>(items));
        }
    }

    /** Executes the declarations, one step at a time. */
    private static final class Interpreter {
        private final Wiring wiring;
        private final World now;
        private final List<World> next = new ArrayList<>();
        private final Set<String> all;

        Interpreter(Wiring wiring, World now) {
            this.wiring = wiring;
            this.now = now;
            all = Set.copyOf(wiring.components());
        }

        List<World> next() {
            now.at().forEach(this::component);
            for (var receiver : wiring.components()) {
                for (var message : wiring.protocol(receiver).received()) {
                    var box = wiring.mailbox(receiver).orElseThrow();
                    var isFull = now.mail().get(receiver).size() == box.capacity();
                    if (wiring.isOpen(receiver + "." + message)
                            && (!isFull || box.overflow() == Overflow.DROP_OLDEST)) {
                        step(world -> deliver(world, receiver, message, box.capacity()));
                    }
                }
            }
            return next;
        }

        private void step(Consumer<World> change) {
            var world = now.copy();
            change.accept(world);
            next.add(world);
        }

        private static void deliver(World world, String receiver, String message, int capacity) {
            var mail = new ArrayList<>(world.mail().get(receiver));
            mail.add(message);
            world.mail().put(receiver, List.copyOf(mail.size() > capacity ? mail.subList(1, mail.size()) : mail));
        }

        private void component(String me, Status status) {
            switch (status) {
                case Status.In(var state) -> {
                    wiring.protocol(me).out(state).forEach(step -> out(me, step));
                    failing(me, state, world -> {});
                }
                case Status.Waiting(var request) -> {
                    request.onTimeout().ifPresent(state -> step(world -> go(world, me, state)));
                    failing(me, request.from(), world -> {});
                }
                case Status.Served(var request) -> {
                    var provider = wiring.provider(me, request);
                    request.onTimeout()
                            .ifPresent(state -> step(world -> {
                                go(world, me, state);
                                giveUp(world, provider);
                            }));
                    failing(me, request.from(), world -> giveUp(world, provider));
                }
                case Status.Serving serving -> serving(me, serving);
                case Status.Closing(var number) -> close(me, number);
            }
        }

        private static void go(World world, String component, String state) {
            world.at().put(component, new Status.In(state));
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
                    .ifPresent(down -> step(world -> {
                        more.accept(world);
                        world.holds().put(me, List.of());
                        if (questions(me).isEmpty() && streams(me).isEmpty()) {
                            go(world, me, down);
                        } else {
                            world.at().put(me, new Status.Closing(0));
                        }
                    }));
        }

        private List<String> questions(String me) {
            return wiring.protocol(me)
                    .steps(Step.Asks.class)
                    .map(asks -> wiring.provider(me, asks) + "." + asks.call())
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
            var key = caller + ">" + me + "." + offer.call();
            if (!serving.isDone()) {
                step(world -> world.at().put(me, new Status.Serving(offer, caller, serving.what(), true)));
            } else {
                step(world -> {
                    go(world, me, offer.to());
                    switch (serving.what()) {
                        case REQUEST ->
                            go(
                                    world,
                                    caller,
                                    ((Status.Served) now.at().get(caller))
                                            .request()
                                            .to());
                        case QUESTION -> world.questions().put(key, Phase.SETTLED);
                        case NOBODY -> {}
                    }
                });
            }
            failing(me, offer.from(), world -> {
                switch (serving.what()) {
                    case REQUEST ->
                        go(
                                world,
                                caller,
                                ((Status.Served) now.at().get(caller))
                                        .request()
                                        .onRejection()
                                        .orElseThrow());
                    case QUESTION -> world.questions().put(key, Phase.REJECTED);
                    case NOBODY -> {}
                }
            });
        }

        private void close(String me, int number) {
            var questions = questions(me);
            var streams = streams(me);
            step(world -> {
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
        }

        /** The question that is an open stream of a call. */
        private Optional<String> subscriber(String provider, String call) {
            return now.questions().entrySet().stream()
                    .filter(entry -> entry.getKey().endsWith(">" + provider + "." + call))
                    .filter(entry -> entry.getValue() == Phase.OPEN)
                    .map(Map.Entry::getKey)
                    .findFirst();
        }

        private void out(String me, Step step) {
            Consumer<World> arrive = world -> go(world, me, step.to());
            switch (step) {
                case Step.Does does -> step(arrive);
                case Step.Stops stops -> step(arrive);
                case Step.Requests request -> step(world -> world.at().put(me, new Status.Waiting(request)));
                case Step.Acquires acquires -> {
                    var resource = wiring.bound(me, acquires.resource());
                    var held = now.holds().values().stream()
                            .flatMap(List::stream)
                            .filter(resource::equals)
                            .count();
                    if (held < wiring.resources().get(resource)) {
                        step(arrive.andThen(world -> hold(world, me, resource, true)));
                    }
                }
                case Step.Releases releases ->
                    step(arrive.andThen(world -> hold(world, me, wiring.bound(me, releases.resource()), false)));
                case Step.Receives receives -> {
                    var mail = now.mail().get(me);
                    if (!mail.isEmpty() && mail.get(0).equals(receives.call())) {
                        step(arrive.andThen(world -> world.mail().put(me, List.copyOf(mail.subList(1, mail.size())))));
                    }
                }
                case Step.Sends sends -> send(me, sends, arrive);
                case Step.Incoming offer -> offer(me, offer, arrive);
                case Step.Asks asks -> {
                    var key = me + ">" + wiring.provider(me, asks) + "." + asks.call();
                    if (!now.questions().containsKey(key)) {
                        step(arrive.andThen(world -> world.questions().put(key, Phase.ASKED)));
                    }
                }
                case Step.Cancels cancels ->
                    step(arrive.andThen(
                            world -> cancel(world, me, wiring.provider(me, cancels) + "." + cancels.call())));
                case Step.Takes takes -> take(me, takes, arrive);
                case Step.Emits emits -> {
                    var key = subscriber(me, emits.call());
                    if (key.isEmpty()) {
                        step(arrive);
                    } else if (now.items().getOrDefault(key.get(), 0) < wiring.window(me, emits.call())) {
                        step(arrive.andThen(world -> world.items().merge(key.get(), 1, Integer::sum)));
                    }
                }
                case Step.Finishes finishes ->
                    step(arrive.andThen(world -> subscriber(me, finishes.call())
                            .ifPresent(key -> world.questions().put(key, Phase.SETTLED))));
            }
        }

        private static void hold(World world, String me, String resource, boolean isTaken) {
            var held = new ArrayList<>(world.holds().get(me));
            if (isTaken) {
                held.add(resource);
            } else {
                held.remove(resource);
            }
            world.holds().put(me, List.copyOf(held));
        }

        private void send(String me, Step.Sends sends, Consumer<World> arrive) {
            var receiver = wiring.provider(me, sends);
            var box = wiring.mailbox(receiver).orElseThrow();
            var isFull = now.mail().get(receiver).size() == box.capacity();
            if (!isFull || box.overflow() == Overflow.DROP_OLDEST) {
                step(arrive.andThen(world -> deliver(world, receiver, sends.call(), box.capacity())));
            } else if (box.overflow() == Overflow.REJECT) {
                step(world -> go(world, me, sends.onRejection().orElse(sends.to())));
            }
        }

        private void take(String me, Step.Takes takes, Consumer<World> arrive) {
            var provider = wiring.provider(me, takes);
            var key = me + ">" + provider + "." + takes.call();
            var phase = now.questions().get(key);
            var items = now.items().getOrDefault(key, 0);
            if (takes.outcome() == Outcome.ANSWER && wiring.protocol(provider).isStream(takes.call())) {
                if (items > 0) {
                    step(arrive.andThen(world -> {
                        world.items().remove(key);
                        if (items > 1) {
                            world.items().put(key, items - 1);
                        }
                    }));
                }
                return;
            }
            var wanted = takes.outcome() == Outcome.REJECTION ? Phase.REJECTED : Phase.SETTLED;
            if (phase == wanted && items == 0) {
                step(arrive.andThen(world -> world.questions().remove(key)));
            }
        }

        private void offer(String me, Step.Incoming offer, Consumer<World> arrive) {
            if (wiring.callers(me, offer.call(), all).isEmpty()) {
                step(arrive);
                return;
            }
            now.at().forEach((caller, status) -> {
                if (status instanceof Status.Waiting(var request)
                        && wiring.provider(caller, request).equals(me)
                        && request.call().equals(offer.call())) {
                    if (offer instanceof Step.Provides provides) {
                        step(world -> {
                            world.at().put(caller, new Status.Served(request));
                            world.at().put(me, new Status.Serving(provides, caller, For.REQUEST, false));
                        });
                    } else if (offer instanceof Step.Rejects) {
                        step(arrive.andThen(
                                world -> go(world, caller, request.onRejection().orElseThrow())));
                    }
                }
            });
            now.questions().forEach((key, phase) -> {
                if (phase != Phase.ASKED || !key.endsWith(">" + me + "." + offer.call())) {
                    return;
                }
                var caller = key.substring(0, key.indexOf('>'));
                switch (offer) {
                    case Step.Provides provides ->
                        step(world -> {
                            world.questions().put(key, Phase.OPEN);
                            world.at().put(me, new Status.Serving(provides, caller, For.QUESTION, false));
                        });
                    case Step.Streams streams -> {
                        if (subscriber(me, streams.call()).isEmpty()) {
                            step(arrive.andThen(world -> world.questions().put(key, Phase.OPEN)));
                        }
                    }
                    default -> step(arrive.andThen(world -> world.questions().put(key, Phase.REJECTED)));
                }
            });
        }
    }

    // ---- random wirings

    /** Plans what each component offers, then draws the states that offer and use it. */
    static final class RandomWiring {
        private final Random random;
        private List<Plan> plans = List.of();

        /** What the others may know about a component. */
        private record Plan(
                String name,
                boolean calls,
                boolean streams,
                int messages,
                boolean rejects,
                boolean fails,
                boolean finishes,
                Overflow overflow) {
            boolean mayReject(String call) {
                return fails || call.equals("call") && rejects;
            }
        }

        RandomWiring(Random random) {
            this.random = random;
        }

        Wiring wiring(String name) {
            while (true) {
                try {
                    return attempt(name);
                } catch (IllegalArgumentException e) {
                    // does not fit together: the next attempt has other random numbers
                }
            }
        }

        private Wiring attempt(String name) {
            var count = 2 + random.nextInt(2);
            var planned = new ArrayList<Plan>();
            for (var i = 0; i < count; i++) {
                planned.add(new Plan(
                        "c" + i,
                        random.nextInt(3) > 0,
                        random.nextInt(4) == 0,
                        random.nextInt(3) == 0 ? 2 : random.nextInt(2),
                        random.nextInt(4) == 0,
                        random.nextInt(8) == 0,
                        random.nextBoolean(),
                        Overflow.values()[random.nextInt(3)]));
            }
            plans = planned;
            var wiring = Wiring.of(name);
            var offered = new HashSet<String>();
            var used = new HashSet<String>();
            for (var plan : plans) {
                var protocol = protocol(plan);
                wiring.component(protocol);
                protocol.provided().forEach(call -> offered.add(plan.name + "." + call));
                protocol.received().forEach(message -> offered.add(plan.name + "." + message));
                used.addAll(protocol.requested());
                used.addAll(protocol.sent());
                if (plan.messages > 0) {
                    wiring.mailbox(plan.name, 1 + random.nextInt(2), plan.overflow);
                }
                if (plan.streams && random.nextBoolean()) {
                    wiring.window(plan.name + ".flow", 2);
                }
            }
            offered.removeAll(used);
            offered.stream().sorted().forEach(wiring::open);
            return wiring.resource("r0", 1)
                    .resource("r1", 1 + random.nextInt(2))
                    .build();
        }

        private Protocol protocol(Plan me) {
            var states = 2 + random.nextInt(2);
            var held = new ArrayList<>(List.of(""));
            var out = new ArrayList<Map<String, Branch>>();
            for (var i = 0; i < states; i++) {
                held.add(random.nextInt(4) == 0 ? "r" + random.nextInt(2) : "");
                out.add(new LinkedHashMap<>());
            }
            for (var state = 0; state < states; state++) {
                var ways = 1 + random.nextInt(2);
                for (var i = 0; i < ways; i++) {
                    draw(me, out.get(state), state, i == 0 ? (state + 1) % states : random.nextInt(states), held);
                }
                if (state > 0 && held.get(state).isEmpty() && random.nextInt(5) == 0) {
                    add(out.get(state), Protocol.stops());
                }
            }
            required(me, out).forEach(kind -> {
                var state = random.nextInt(states);
                add(out.get(state), kind.then("s" + state));
            });
            var builder = Protocol.of(me.name);
            for (var state = 0; state < states; state++) {
                builder.state("s" + state, out.get(state).values().toArray(new Branch[0]));
            }
            if (me.fails) {
                builder.failsTo("s" + emptyHanded(states, held));
            }
            return builder.build();
        }

        private int emptyHanded(int states, List<String> held) {
            var state = random.nextInt(states);
            return held.get(state).isEmpty() ? state : 0;
        }

        private void draw(Plan me, Map<String, Branch> out, int state, int to, List<String> held) {
            var here = held.get(state);
            var there = held.get(to);
            var target = "s" + to;
            if (here.equals(there)) {
                var kinds = kinds(me);
                var kind = kinds.get(random.nextInt(kinds.size()));
                var branch = kind.then(target);
                var word = branch.toString();
                var other = word.startsWith("requests c") || word.startsWith("sends c")
                        ? plans.get(word.charAt(word.indexOf(" c") + 2) - '0')
                        : me;
                if (word.startsWith("requests") && random.nextInt(3) == 0) {
                    branch = branch.orTimeout("s" + state);
                }
                if (word.startsWith("requests") && other.mayReject("call")
                        || word.startsWith("sends") && other.overflow == Overflow.REJECT && random.nextBoolean()) {
                    branch = branch.orRejected("s" + state);
                }
                add(out, branch);
            } else if (here.isEmpty()) {
                add(out, Protocol.acquires(there).then(target));
            } else if (there.isEmpty()) {
                add(out, Protocol.releases(here).then(target));
            }
        }

        /** The steps that a component may take. */
        private List<Branch.Builder> kinds(Plan me) {
            var kinds = new ArrayList<Branch.Builder>();
            for (var other : plans) {
                if (other == me) {
                    continue;
                }
                if (other.calls) {
                    kinds.add(Protocol.requests(other.name + ".call"));
                    kinds.add(Protocol.asks(other.name + ".call"));
                }
                if (other.streams) {
                    kinds.add(Protocol.asks(other.name + ".flow"));
                }
                for (var message = 0; message < other.messages; message++) {
                    kinds.add(Protocol.sends(other.name + ".m" + message));
                }
            }
            kinds.addAll(own(me));
            if (kinds.isEmpty() || random.nextInt(4) == 0) {
                kinds.add(Protocol.does("x"));
            }
            return kinds;
        }

        private static List<Branch.Builder> own(Plan me) {
            var own = new ArrayList<Branch.Builder>();
            if (me.calls) {
                own.add(Protocol.provides("call"));
                if (me.rejects) {
                    own.add(Protocol.rejects("call"));
                }
            }
            if (me.streams) {
                own.add(Protocol.streams("flow"));
                own.add(Protocol.emits("flow"));
                if (me.finishes) {
                    own.add(Protocol.finishes("flow"));
                }
            }
            for (var message = 0; message < me.messages; message++) {
                own.add(Protocol.receives("m" + message));
            }
            return own;
        }

        /** What has to be in some state: what the others expect of the component, and what comes back to it. */
        private List<Branch.Builder> required(Plan me, List<Map<String, Branch>> out) {
            var required = new ArrayList<>(own(me));
            for (var other : plans) {
                for (var call : List.of("call", "flow")) {
                    var target = other.name + "." + call;
                    if (out.stream().noneMatch(branches -> branches.containsKey("asks " + target))) {
                        continue;
                    }
                    required.add(Protocol.answered(target));
                    if (other.mayReject(call)) {
                        required.add(Protocol.rejected(target));
                    }
                    if (call.equals("flow") && other.finishes) {
                        required.add(Protocol.finished(target));
                    }
                    if (random.nextBoolean()) {
                        required.add(Protocol.cancels(target));
                    }
                }
            }
            return required;
        }

        private static void add(Map<String, Branch> out, Branch branch) {
            out.putIfAbsent(branch.toString(), branch);
        }
    }
}
