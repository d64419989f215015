package io.troupe.actor;

import java.lang.management.ManagementFactory;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.function.LongSupplier;
import javax.management.Attribute;
import javax.management.AttributeList;
import javax.management.AttributeNotFoundException;
import javax.management.DynamicMBean;
import javax.management.JMException;
import javax.management.MBeanAttributeInfo;
import javax.management.MBeanInfo;
import javax.management.MBeanServer;
import javax.management.ObjectName;
import org.jspecify.annotations.Nullable;

/**
 * The figures of a space as a bean of JMX; see {@link ActorSpace#registerBean}. The only class that needs the module
 * {@code java.management}.
 */
final class SpaceBean implements DynamicMBean {
    private record Figure(String description, LongSupplier value) {}

    private final String space;
    private final Map<String, Figure> figures = new LinkedHashMap<>();

    private SpaceBean(String space, SpaceMetrics metrics) {
        this.space = space;
        figure("Served", "entries processed since the space was created", metrics::served);
        figure("Waiting", "entries that were processed before the last probe", metrics::waiting);
        figure(
                "LatencyMicros",
                "how long the last probe was queued",
                () -> metrics.latency().toNanos() / 1_000);
        figure("Actors", "actors that have started and not stopped", () -> metrics.actors());
        figure("Timers", "timers that are set", () -> metrics.timers());
        figure("Errors", "errors reported to error handlers", metrics::errors);
        figure("DeadLetters", "messages that were not delivered", metrics::deadLetters);
        figure(
                "Abandoned",
                "requests that were not begun, because their callers had given them up",
                metrics::abandoned);
        figure("Expired", "time limits of promises that have passed", metrics::expired);
    }

    private void figure(String name, String description, LongSupplier value) {
        figures.put(name, new Figure(description, value));
    }

    /**
     * Registers the bean of a space.
     *
     * @return removes it; does nothing if that was done before
     */
    static Runnable register(String space, SpaceMetrics metrics) {
        MBeanServer server = ManagementFactory.getPlatformMBeanServer();
        try {
            var name = new ObjectName("io.troupe:type=ActorSpace,name=" + ObjectName.quote(space));
            server.registerMBean(new SpaceBean(space, metrics), name);
            return () -> remove(server, name);
        } catch (JMException refused) {
            throw new ActorException(
                    "the bean of space " + space + " cannot be registered: " + refused
                            + "; a bean that exists already is that of another space of this name",
                    refused);
        }
    }

    private static void remove(MBeanServer server, ObjectName name) {
        try {
            if (server.isRegistered(name)) {
                server.unregisterMBean(name);
            }
        } catch (JMException gone) {
            throw new ActorException("the bean " + name + " cannot be removed: " + gone, gone);
        }
    }

    @Override
    public Object getAttribute(String attribute) throws AttributeNotFoundException {
        Figure figure = figures.get(attribute);
        if (figure == null) {
            throw new AttributeNotFoundException(attribute + ", expected one of " + figures.keySet());
        }
        return figure.value.getAsLong();
    }

    @Override
    public AttributeList getAttributes(String[] attributes) {
        var list = new AttributeList();
        for (String attribute : attributes) {
            Figure figure = figures.get(attribute);
            if (figure != null) {
                list.add(new Attribute(attribute, figure.value.getAsLong()));
            }
        }
        return list;
    }

    @Override
    public void setAttribute(Attribute attribute) throws AttributeNotFoundException {
        throw new AttributeNotFoundException(attribute.getName() + " cannot be set");
    }

    @Override
    public AttributeList setAttributes(AttributeList attributes) {
        return new AttributeList();
    }

    @Override
    public @Nullable Object invoke(String action, Object[] parameters, String[] signature) {
        throw new UnsupportedOperationException(action + ": the bean of a space has no operations");
    }

    @Override
    public MBeanInfo getMBeanInfo() {
        var attributes = figures.entrySet().stream()
                .map(each -> new MBeanAttributeInfo(
                        each.getKey(), long.class.getName(), each.getValue().description, true, false, false))
                .toArray(MBeanAttributeInfo[]::new);
        return new MBeanInfo(
                SpaceBean.class.getName(), "figures of actor space " + space, attributes, null, null, null);
    }
}
