package io.troupe.services.component.application;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.services.broker.Broker;
import io.troupe.services.broker.MissingServiceException;
import io.troupe.services.broker.Need;
import io.troupe.services.broker.ServiceRecord;
import io.troupe.services.bus.Bus;
import io.troupe.services.bus.BusPort;
import io.troupe.services.component.Component;
import io.troupe.services.component.ComponentInterface;
import io.troupe.services.component.application.ApplicationPlan.Replacement;
import java.util.ArrayList;
import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.jspecify.annotations.Nullable;

/**
 * An application that runs.
 *
 * <p><b>Role.</b> Puts the components of its plan on the bus, registers them with the broker, and asks the broker for
 * all its needs: that is what starts components, and only those that are needed. Then it keeps each user connected with
 * the provider that the broker names.
 *
 * <p><b>Threads.</b> One actor space, on which it is started, stopped, and tells its observers. Bus and broker belong
 * to it, and are closed with it.
 *
 * <p><b>Order.</b> Needs are met one after the other, in the order of the plan; replacements are timed from the moment
 * when all are. When one provider takes the place of another its wires do so in one turn of the space.
 *
 * <p><b>Errors.</b> A need that nobody can meet, or that stays unmet longer than the patience, ends the application:
 * everything that was started is stopped, and then {@link #started} or {@link #ended} is rejected with the broker's
 * {@link MissingServiceException}. So do two needs that would feed one topic, with an {@link ApplicationException}.
 * {@link #replace} and {@link #add} are rejected with one when it is being stopped, or has been.
 *
 * <p><b>Source.</b> Paper, sections 1 ("terminate gracefully with proper error messages"), 2.1.3 and 2.2.4.
 */
public final class Application {
    private final ActorSpace space;
    private final ApplicationPlan plan;
    private final Bus bus;
    private final Broker broker;
    private final ApplicationSettings settings;
    private final BusPort port;
    private final Wiring wiring;
    private final Map<String, ComponentInterface<?, ?>> interfaces = new LinkedHashMap<>();
    private final List<Usage> usages = new ArrayList<>();
    private final Deferred<@Nullable Void> started = new Deferred<>();
    private final Deferred<@Nullable Void> ended = new Deferred<>();
    private final Losses losses = new Losses();
    private boolean ending;

    private Application(ActorSpace space, ApplicationPlan plan, Bus bus, Broker broker, ApplicationSettings settings) {
        this.space = space;
        this.plan = plan;
        this.bus = bus;
        this.broker = broker;
        this.settings = settings;
        this.port = bus.attach(plan.name() + ":application");
        this.wiring = new Wiring(port, plan.components(), settings.events());
    }

    /**
     * Starts an application.
     *
     * @throws IllegalStateException on any thread but that of an actor space
     */
    public static Application start(ApplicationPlan plan, Bus bus, Broker broker, ApplicationSettings settings) {
        ActorSpace space = ActorSpace.current();
        if (space == null) {
            throw new IllegalStateException("application " + plan.name()
                    + " was started on no actor space, expected the one it is to live on: use space.execute(..)");
        }
        var application = new Application(space, plan, bus, broker, settings);
        application.begin();
        return application;
    }

    /** Fulfilled when all needs are met; rejected if one cannot be, after everything has been stopped again. */
    public Promise<@Nullable Void> started() {
        return started;
    }

    /** Fulfilled when it has been stopped; rejected with what has ended it. */
    public Promise<@Nullable Void> ended() {
        return ended;
    }

    private void begin() {
        ended.exceptionally(error -> null); // whoever waits for the start hears of it there
        Promise<?> registered = Promise.done();
        try {
            for (var each : plan.components().entrySet()) {
                var face = ComponentInterface.open(bus, each.getKey(), each.getValue(), settings.components());
                interfaces.put(each.getKey(), face);
            }
            wiring.claim(null, plan.wires());
            wiring.open(plan.wires());
            for (var face : interfaces.values()) {
                if (plan.isOffered(face.address().name())) {
                    var component = face.component();
                    registered = both(
                            registered,
                            broker.register(component.service(), component.capabilities(), face.address(), face));
                }
            }
        } catch (RuntimeException refused) {
            end(refused);
            return;
        }
        registered
                .thenCompose(all -> meet(plan.needs().iterator()))
                .thenAccept(met -> run())
                .exceptionally(error -> {
                    end(error);
                    return null;
                });
    }

    private static Promise<?> both(Promise<?> first, Promise<?> second) {
        return first.thenCombine(second, (one, other) -> one);
    }

    private Promise<?> meet(Iterator<Need> needs) {
        if (ending || !needs.hasNext()) {
            return Promise.done();
        }
        var usage = new Usage(needs.next(), wiring, settings.events(), losses);
        usages.add(usage);
        return broker.connect(usage.need(), usage).thenCompose(provider -> meet(needs));
    }

    private void run() {
        if (ending) {
            return;
        }
        started.resolve(null);
        for (var replacement : plan.replacements()) {
            space.delay(replacement.after()).handle((over, closed) -> {
                if (closed == null && !ending) {
                    replace(replacement);
                }
                return null;
            });
        }
    }

    private void replace(Replacement what) {
        replace(what.old(), what.by()).handle((done, error) -> {
            settings.events()
                    .accept(
                            error == null
                                    ? new ApplicationEvent.Replaced(what)
                                    : new ApplicationEvent.NotReplaced(what, error));
            return null;
        });
    }

    /**
     * Puts a component in the place of another, under the service that this one is registered for, while the
     * application runs.
     *
     * @param by a component of the plan that is not in use
     */
    public Promise<@Nullable Void> replace(String old, String by) {
        if (ending) {
            return Promise.failed(over("replaces nothing"));
        }
        var before = face(old);
        var next = face(by);
        return broker.registered()
                .thenCompose(all -> {
                    var offer = offerOf(before, all);
                    var capabilities = new ArrayList<>(offer.capabilities());
                    next.component().capabilities().stream()
                            .filter(each -> !capabilities.contains(each))
                            .forEach(capabilities::add);
                    return broker.replace(before.address(), offer.service(), capabilities, next.address(), next);
                })
                .thenAccept(replaced -> {});
    }

    /** What a component offers: not what it was made for, if it has itself taken the place of another. */
    private ServiceRecord offerOf(ComponentInterface<?, ?> face, List<ServiceRecord> all) {
        return all.stream()
                .filter(each -> each.provider().equals(face.address()))
                .findFirst()
                .orElseThrow(() -> new ApplicationException(face.address().name()
                        + " offers nothing now, expected a component in whose place another can be put"));
    }

    /**
     * Connects one more component on the fly: it is registered, and started as soon as somebody needs it.
     *
     * @param name as the component's maker was given
     * @throws IllegalArgumentException if there is a component of that name
     */
    public Promise<ServiceRecord> add(String name, Component<?, ?> component) {
        if (ending) {
            return Promise.failed(over("takes no component " + name));
        }
        var face = ComponentInterface.open(bus, name, component, settings.components());
        interfaces.put(name, face);
        wiring.know(name, component);
        return broker.register(component.service(), component.capabilities(), face.address(), face);
    }

    private ApplicationException over(String what) {
        return new ApplicationException(plan.name() + " has been stopped, and " + what);
    }

    /** The interface of a component. */
    public ComponentInterface<?, ?> face(String component) {
        var face = interfaces.get(component);
        if (face == null) {
            throw new IllegalArgumentException(
                    plan.name() + " has no component " + component + ", it has " + interfaces.keySet());
        }
        return face;
    }

    private final class Losses implements Usage.Losses {
        @Override
        public void lost(Usage usage, MissingServiceException why) {
            if (!ending) {
                awaitAnother(usage, why);
            }
        }

        @Override
        public void clash(ApplicationException why) {
            end(why);
        }
    }

    private void awaitAnother(Usage usage, MissingServiceException why) {
        settings.events().accept(new ApplicationEvent.Lost(usage.need(), why));
        int met = usage.timesMet();
        space.delay(settings.patience()).handle((over, closed) -> {
            if (closed == null
                    && usage.timesMet() == met) { // else it had one meanwhile, and a later loss has its own time
                end(why);
            }
            return null;
        });
    }

    // ---- the end

    /** Stops everything that was started, in reverse order, and leaves the bus. */
    public Promise<@Nullable Void> stop() {
        end(null);
        return ended;
    }

    private void end(@Nullable Throwable why) {
        if (ending) {
            return;
        }
        ending = true;
        broker.shutDown().handle((left, error) -> {
            usages.forEach(Usage::disconnect);
            interfaces.values().forEach(ComponentInterface::close);
            bus.close();
            settle(why != null ? why : error);
            return null;
        });
    }

    private void settle(@Nullable Throwable why) {
        if (why == null) {
            started.resolve(null); // whoever stops it before it has started does not wait for that any more
            ended.resolve(null);
        } else {
            started.reject(why);
            ended.reject(why);
        }
    }
}
