package io.troupe.actor;

import static org.objectweb.asm.Opcodes.*;

import io.troupe.actor.ProxyGenerator.Kind;
import io.troupe.actor.internal.Router;
import java.lang.invoke.MethodHandles;
import java.lang.reflect.Method;
import java.util.function.IntConsumer;
import org.objectweb.asm.ClassWriter;
import org.objectweb.asm.Label;
import org.objectweb.asm.MethodVisitor;
import org.objectweb.asm.Type;

/**
 * Generates the proxy of a pool of actors of one type, in the package of that type. It forwards each call to the
 * proxies of the actors that its router chooses.
 *
 * <p>For {@code interface Greeter { Promise<String> greet(String name); }} it generates what this would compile to:
 *
 * {@snippet lang = "text":
 * final class Greeter$$Pool implements Greeter {
 *     Router troupe$router;
 *     public Promise<String> greet(String a0) {
 *         Router router = troupe$router;
 *         int number = router.first(a0);
 *         Promise<String> answer = ((Greeter) router.actor(number)).greet(a0);
 *         while ((number = router.after(number)) >= 0) {
 *             answer = Request.both(answer, ((Greeter) router.actor(number)).greet(a0));
 *         }
 *         return answer;
 *     }
 * }
 * }
 *
 * <p>An argument that is a callback is replaced before the first call, {@code a0 = (Callback) router.callback(a0)}, and
 * {@code router.called(a0)} follows the last one.
 */
final class PoolProxyGenerator {
    static final String ROUTER_FIELD = "troupe$router";
    private static final String ROUTER = Type.getInternalName(Router.class);
    private static final String ROUTER_DESCRIPTOR = Type.getDescriptor(Router.class);
    private static final String CALLBACK = Type.getInternalName(Callback.class);
    private static final String PROMISE_DESCRIPTOR = Type.getDescriptor(Promise.class);

    private final Class<?> type;
    private final String typeName;
    private final String proxyName;
    private final ActorMethods methods;
    private final MethodHandles.Lookup lookup;

    PoolProxyGenerator(Class<?> type, ActorMethods methods, MethodHandles.Lookup lookup) {
        this.type = type;
        this.typeName = Type.getInternalName(type);
        this.proxyName = typeName + "$$Pool";
        this.methods = methods;
        this.lookup = lookup;
    }

    Class<?> generate() {
        boolean isInterface = type.isInterface();
        String superName = isInterface ? "java/lang/Object" : typeName;
        var writer = new ClassWriter(ClassWriter.COMPUTE_FRAMES); // the types at the only jump of each method are equal
        writer.visit(
                V21,
                ACC_FINAL | ACC_SUPER | ACC_SYNTHETIC,
                proxyName,
                null,
                superName,
                isInterface ? new String[] {typeName} : new String[0]);
        ProxyGenerator.target(writer, proxyName, isInterface, ROUTER_FIELD, ROUTER_DESCRIPTOR);
        methods.messages().forEach(method -> forward(writer, method));
        new ProxyGenerator.LocalMethods(type, proxyName, ROUTER_FIELD, ROUTER, methods).write(writer);
        writer.visitEnd();
        return ProxyGenerator.define(lookup, type, writer.toByteArray());
    }

    private void forward(ClassWriter writer, Method method) {
        Kind kind = Kind.of(method);
        int slots = Type.getArgumentsAndReturnSizes(Type.getMethodDescriptor(method)) >> 2;
        int router = slots; // the locals behind this and the arguments
        int number = slots + 1;
        int answer = slots + 2;
        MethodVisitor code =
                writer.visitMethod(ACC_PUBLIC, method.getName(), Type.getMethodDescriptor(method), null, null);
        code.visitCode();
        code.visitVarInsn(ALOAD, 0);
        code.visitFieldInsn(GETFIELD, proxyName, ROUTER_FIELD, ROUTER_DESCRIPTOR);
        code.visitVarInsn(ASTORE, router);
        if (kind == Kind.SUSPENDING) {
            code.visitVarInsn(ALOAD, router);
            code.visitLdcInsn(ActorMethods.show(method));
            routerCall(code, "checkSuspending", "(Ljava/lang/String;)V");
        }
        first(code, method, kind, router);
        code.visitVarInsn(ISTORE, number);
        if (kind == Kind.SUSPENDING) {
            call(code, method, router, number);
            code.visitInsn(ARETURN);
        } else {
            forEachCallback(method, local -> {
                code.visitVarInsn(ALOAD, router);
                code.visitVarInsn(ALOAD, local);
                routerCall(code, "callback", "(Ljava/lang/Object;)Ljava/lang/Object;");
                code.visitTypeInsn(CHECKCAST, CALLBACK);
                code.visitVarInsn(ASTORE, local);
            });
            call(code, method, router, number);
            loop(code, method, kind, router, number, answer);
        }
        ProxyGenerator.finish(code);
    }

    /** The number of the first actor, by the first argument. */
    private static void first(MethodVisitor code, Method method, Kind kind, int router) {
        code.visitVarInsn(ALOAD, router);
        Type[] arguments = kind.arguments(method);
        if (arguments.length == 0) {
            code.visitLdcInsn(ActorMethods.show(method));
            routerCall(code, "firstWithoutArgument", "(Ljava/lang/String;)I");
        } else {
            code.visitVarInsn(arguments[0].getOpcode(ILOAD), 1);
            ProxyGenerator.box(code, arguments[0]);
            routerCall(code, "first", "(Ljava/lang/Object;)I");
        }
    }

    private void call(MethodVisitor code, Method method, int router, int number) {
        code.visitVarInsn(ALOAD, router);
        code.visitVarInsn(ILOAD, number);
        routerCall(code, "actor", "(I)Ljava/lang/Object;");
        code.visitTypeInsn(CHECKCAST, typeName);
        int local = 1;
        for (Type argument : Type.getArgumentTypes(method)) {
            code.visitVarInsn(argument.getOpcode(ILOAD), local);
            local += argument.getSize();
        }
        boolean isInterface = type.isInterface();
        code.visitMethodInsn(
                isInterface ? INVOKEINTERFACE : INVOKEVIRTUAL,
                typeName,
                method.getName(),
                Type.getMethodDescriptor(method),
                isInterface);
    }

    /** Calls the other actors, and returns the promise of all answers. */
    private void loop(MethodVisitor code, Method method, Kind kind, int router, int number, int answer) {
        boolean isRequest = kind == Kind.REQUEST;
        if (isRequest) {
            code.visitVarInsn(ASTORE, answer);
        }
        var again = new Label();
        var end = new Label();
        code.visitLabel(again);
        code.visitVarInsn(ALOAD, router);
        code.visitVarInsn(ILOAD, number);
        routerCall(code, "after", "(I)I");
        code.visitInsn(DUP);
        code.visitVarInsn(ISTORE, number);
        code.visitJumpInsn(IFLT, end);
        if (isRequest) {
            code.visitVarInsn(ALOAD, answer);
        }
        call(code, method, router, number);
        if (isRequest) {
            String both = "(" + PROMISE_DESCRIPTOR + PROMISE_DESCRIPTOR + ")" + PROMISE_DESCRIPTOR;
            code.visitMethodInsn(INVOKESTATIC, Type.getInternalName(Request.class), "both", both, false);
            code.visitVarInsn(ASTORE, answer);
        }
        code.visitJumpInsn(GOTO, again);
        code.visitLabel(end);
        forEachCallback(method, local -> {
            code.visitVarInsn(ALOAD, router);
            code.visitVarInsn(ALOAD, local);
            routerCall(code, "called", "(Ljava/lang/Object;)V");
        });
        if (isRequest) {
            code.visitVarInsn(ALOAD, answer);
        }
        code.visitInsn(isRequest ? ARETURN : RETURN);
    }

    /** Calls an action with the local variable of each argument that is a callback. */
    private static void forEachCallback(Method method, IntConsumer action) {
        int local = 1;
        for (Type argument : Type.getArgumentTypes(method)) {
            if (argument.getInternalName().equals(CALLBACK)) {
                action.accept(local);
            }
            local += argument.getSize();
        }
    }

    private static void routerCall(MethodVisitor code, String name, String descriptor) {
        code.visitMethodInsn(INVOKEVIRTUAL, ROUTER, name, descriptor, false);
    }
}
