package io.troupe.broker;

import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;

/** The interfaces that one process calls, or offers, over its bus. Used from any thread. */
final class CallableInterfaces {
    final CallableMethods.Values values = new CallableMethods.Values();
    private final Map<Class<?>, CallableMethods> known = new ConcurrentHashMap<>();

    /** @throws IllegalArgumentException if it has a method that cannot be called from other processes */
    CallableMethods of(Class<?> type) {
        CallableMethods methods = known.get(type);
        if (methods == null) {
            methods = CallableMethods.of(type, values);
            known.put(type, methods);
        }
        return methods;
    }
}
