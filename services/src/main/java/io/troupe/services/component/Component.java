package io.troupe.services.component;

import io.troupe.services.bus.BusTopic;
import java.util.List;
import java.util.function.Supplier;

/**
 * What is to be known of a component so that it can be given an interface: the service it provides, the topics it hears
 * and publishes, and how to talk to it.
 *
 * @param service the service's name
 * @param capabilities what else it can be found by
 * @param hears the topics from which its input comes
 * @param publishes the topics to which its output goes
 * @param communication makes the CCU of one life
 * @param conversion the rules of the DCU
 * @param input the DCU's buffer towards the component
 * @param output the DCU's buffer towards the application
 * @param <I> the data that the component takes, in its own form
 * @param <O> the data that the component gives, in its own form
 */
public record Component<I, O>(
        String service,
        List<String> capabilities,
        List<BusTopic<?>> hears,
        List<BusTopic<?>> publishes,
        Supplier<? extends ComponentCommunication<I, O>> communication,
        Conversion<I, O> conversion,
        Buffering input,
        Buffering output) {
    public Component {
        capabilities = List.copyOf(capabilities);
        hears = List.copyOf(hears);
        publishes = List.copyOf(publishes);
    }

    /** The same under another name, with other capabilities. */
    public Component<I, O> offering(String newService, List<String> newCapabilities) {
        return new Component<>(newService, newCapabilities, hears, publishes, communication, conversion, input, output);
    }

    /** The same with other buffers. */
    public Component<I, O> buffered(Buffering newInput, Buffering newOutput) {
        return new Component<>(service, capabilities, hears, publishes, communication, conversion, newInput, newOutput);
    }
}
