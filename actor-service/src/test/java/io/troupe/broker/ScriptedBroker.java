package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.bus.Address;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import org.jspecify.annotations.Nullable;

/**
 * A broker that plays scripts. A line of a script has steps, which are taken before the broker's next turn, and after
 * the bar all that followed from them: calls of providers, notifications of clients, events, and results of the steps.
 */
class ScriptedBroker extends BrokerBench {
    /** A word, what it refers to, and options. */
    private static final String STEP = "\\S+( \\S+)?( (with|for|at|by|after|to) \\S+)*";

    private final Map<String, FakeProvider> providers = new HashMap<>();
    private final List<String> reasons = new ArrayList<>(); // of all failures
    private String missing = ""; // the newest error
    private @Nullable Joiner user;

    ScriptedBroker() {
        super(BrokerSettings.defaults());
    }

    final void play(String script) {
        var expected = new ArrayList<String>();
        var played = new ArrayList<String>();
        for (String line : script.lines().toList()) {
            String steps = line.substring(0, line.indexOf('|')).strip();
            String then = line.substring(line.indexOf('|') + 1).strip();
            if (steps.isEmpty()) { // the line before goes on
                expected.add(expected.removeLast() + " " + then);
                continue;
            }
            expected.add(steps + " | " + then);
            diary.clear();
            for (String step : steps.split(", ")) {
                take(step.split(" "));
            }
            test.runQueued();
            played.add(steps + " | " + String.join(", ", diary));
        }
        assertThat(played).isNotEmpty().isEqualTo(expected);
    }

    final void take(String... step) {
        assertThat(String.join(" ", step)).as("step").matches(STEP);
        String who = step.length > 1 ? step[1] : "";
        switch (step[0]) {
            case "offer", "offerLives" -> offer(step, provider(who)); // one object, or one for each life
            case "require" -> note(step, broker.require(need(step)));
            case "find" -> note(step, broker.find(need(step)));
            case "connect" -> connect(need(step), what -> diary.add(who + ": " + what));
            case "withdraw" -> note(step, broker.withdraw(at(who)));
            case "replace" -> note(step, replace(who, step[3], option(step, "at", step[3])));
            case "registered" -> note(step, broker.registered());
            case "close" -> broker.closeAsync().handle((left, error) -> true);
            case "shutDown" -> note(step, broker.closeAsync());
            case "health" -> diary.add(health(who).toString());
            case "why" -> diary.add(missing);
            case "reasons" -> diary.addAll(reasons);
            case "count" -> diary.add("" + countEvents(who));
            case "run" -> test.runQueued();
            case "wait" -> seconds(Integer.parseInt(who));
            case "never" -> reopen(WITHOUT_RESTART);
            case "restart" ->
                reopen(BrokerSettings.defaults()
                        .withRestartPauses(
                                Duration.ofSeconds(Integer.parseInt(step[2])),
                                Duration.ofSeconds(Integer.parseInt(step[4]))));
            case "join" -> {
                user = test.spawn(Joiner.class, User::new);
                user.join();
            }
            case "leave" -> test.space().stop(user);
            default -> provider(step[0].split("\\.")[0]).take(step[0], who);
        }
    }

    private long countEvents(String type) {
        assertThat(BrokerEvent.class.getDeclaredClasses())
                .extracting(Class::getSimpleName)
                .contains(type);
        return events.stream()
                .filter(each -> each.getClass().getSimpleName().equals(type))
                .count();
    }

    private void offer(String[] step, FakeProvider provider) {
        String capabilities = option(step, "with", "");
        String service = option(step, "for", "player");
        List<String> all = capabilities.isEmpty() ? List.of() : List.of(capabilities.split("\\+"));
        Address address = at(option(step, "at", step[1]));
        Promise<ServiceRecord> registered = step[0].equals("offer")
                ? broker.register(service, all, address, provider)
                : broker.register(service, all, address, provider::nextLife);
        registered.exceptionally(error -> {
            note(step, Promise.failed(error));
            return null;
        });
    }

    private static Need need(String[] step) {
        String capability = option(step, "with", null);
        String service = option(step, "for", capability == null ? "player" : null);
        return new Need("robot " + (step.length > 1 ? step[1] : ""), service, capability);
    }

    private Promise<ServiceRecord> replace(String old, String by, String address) {
        return broker.replace(at(old), "player", List.of("better"), at(address), provider(by))
                .thenApply(record -> {
                    assertThat(record.capabilities()).containsExactly("better");
                    return record;
                });
    }

    private static @Nullable String option(String[] step, String name, @Nullable String otherwise) {
        int place = List.of(step).indexOf(name);
        return place < 0 ? otherwise : step[place + 1];
    }

    final FakeProvider provider(String name) {
        return providers.computeIfAbsent(name, FakeProvider::new);
    }

    private void note(String[] step, Promise<?> promise) {
        promise.handle((value, error) -> {
            String result = error == null ? describe(value) : describe(error);
            return diary.add(String.join(" ", step) + ": " + result);
        });
    }

    private static String describe(@Nullable Object value) {
        return switch (value) {
            case ServiceRecord it -> it.provider().name() + " " + it.health();
            case List<?> all ->
                all.stream().map(ScriptedBroker::describe).toList().toString();
            case null, default -> "done";
        };
    }

    private String describe(Throwable error) {
        if (error instanceof MissingServiceException) {
            missing = String.valueOf(error.getMessage());
            return "missing";
        }
        return error.getClass().getSimpleName() + ": " + error.getMessage();
    }

    @Override
    void record(BrokerEvent event) {
        super.record(event);
        switch (event) {
            case BrokerEvent.StartFailed it -> note(it.provider(), "did not start", it.why());
            case BrokerEvent.Failed it -> note(it.provider(), "has failed", it.why());
            case BrokerEvent.StopFailed it -> note(it.provider(), "did not stop", it.why());
            case BrokerEvent.Suspect it -> diary.add(name(it.provider()) + " is suspect");
            case BrokerEvent.Recovered it -> diary.add(name(it.provider()) + " is well again");
            case BrokerEvent.FailedOver it -> diary.add(name(it.from()) + " is followed by " + name(it.to()));
            case BrokerEvent.Late(var provider, var asked, var error) ->
                diary.add("late " + asked + " of " + provider + (error == null ? "" : ": " + error));
            case BrokerEvent.UserFailed it ->
                diary.add(it.need().by() + " fails: " + it.why().getMessage());
            case BrokerEvent.Lost it -> missing = String.valueOf(it.why().getMessage());
            case BrokerEvent.UserGone it -> diary.add(it.need().by() + " is gone");
            default -> {} // follows from the others, or is counted
        }
    }

    private static String name(ServiceRecord provider) {
        return provider.provider().name();
    }

    private void note(ServiceRecord provider, String what, Throwable why) {
        diary.add(name(provider) + " " + what);
        reasons.add(name(provider) + ": " + Reasons.of(why));
    }

    /** A provider whose calls behave as the script specifies. */
    final class FakeProvider implements Provider {
        private final String name;
        private final Map<String, String> manners = new HashMap<>();
        private final Deque<Deferred<@Nullable Void>> unanswered = new ArrayDeque<>();
        private Deferred<@Nullable Void> end = Deferred.unbound();

        private int lives;

        /** The provider of the next life, whose number is a part of its name. */
        Provider nextLife() {
            var life = new FakeProvider(name + ++lives, manners);
            providers.put(life.name, life);
            return life;
        }

        private FakeProvider(String name, Map<String, String> manners) {
            this.name = name;
            this.manners.putAll(manners);
            List.of("start", "stop", "check")
                    .forEach(call -> this.manners.put(
                            name + "." + call, manners.getOrDefault(name.replaceAll("\\d", "") + "." + call, "works")));
        }

        FakeProvider(String name) {
            this.name = name;
            List.of("start", "stop", "check").forEach(call -> manners.put(name + "." + call, "works"));
        }

        void take(String call, String manner) {
            switch (manner) {
                case "works", "fails", "explodes", "hangs" ->
                    assertThat(manners.replace(call, manner)).as(call).isNotNull();
                case "answers" -> unanswered.remove().resolve(null);
                case "rejects" -> unanswered.remove().reject(new IllegalStateException("no"));
                case "dies" -> end.reject(new IllegalStateException("power"));
                default -> throw new IllegalArgumentException(call + " " + manner);
            }
        }

        private Promise<@Nullable Void> answer(String call) {
            return switch (manners.getOrDefault(name + "." + call, "works")) {
                case "fails" -> Promise.failed(new IllegalStateException(name + " is broken"));
                case "explodes" -> throw new IllegalStateException(name + " exploded");
                case "hangs" -> {
                    unanswered.add(Deferred.unbound());
                    yield unanswered.getLast();
                }
                default -> Promise.done();
            };
        }

        @Override
        public Promise<@Nullable Void> start() {
            diary.add("start " + name);
            end = Deferred.unbound();
            return answer("start");
        }

        @Override
        public Promise<@Nullable Void> stop() {
            diary.add("stop " + name);
            return answer("stop");
        }

        @Override
        public Promise<@Nullable Void> check() {
            return answer("check");
        }

        @Override
        public Promise<@Nullable Void> whenEnded() {
            return end;
        }
    }

    /** A client that ignores losses. */
    interface Client extends Broker.Connection {
        @Override
        default void lost(MissingServiceException why) {}
    }

    /** Connects when its method is called. */
    interface Joiner {
        void join();
    }

    private final class User extends Actor implements Joiner, Client {
        @Override
        public void join() {
            broker.connect(Need.ofService("user", "player"), this);
        }

        @Override
        public void use(ServiceRecord provider) {
            diary.add("user: use " + provider.provider().name());
        }
    }
}
