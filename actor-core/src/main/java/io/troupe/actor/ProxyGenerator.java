package io.troupe.actor;

import static org.objectweb.asm.Opcodes.*;

import io.troupe.actor.internal.ActorProxy;
import io.troupe.actor.internal.Message;
import io.troupe.actor.internal.Recipient;
import io.troupe.actor.internal.SuspendingCalls;
import io.troupe.actor.internal.loop.QueueEntry;
import java.lang.invoke.MethodHandles;
import java.lang.reflect.Method;
import java.util.Arrays;
import java.util.List;
import org.objectweb.asm.ClassWriter;
import org.objectweb.asm.Label;
import org.objectweb.asm.MethodVisitor;
import org.objectweb.asm.Type;

/**
 * Generates the classes of one actor type in its own package: for each message a class whose typed fields are the
 * arguments, and the proxy, whose methods create and send these messages.
 *
 * <p>For {@code interface Greeter { Promise<String> greet(String name); }} it generates what this would compile to:
 *
 * {@snippet lang = "text":
 * final class Greeter$$greet$0 extends Request<String> {
 *     final String a0;
 *     Greeter$$greet$0(Recipient cell, String a0) { super(cell); this.a0 = a0; }
 *     protected QueueEntry serve() { Object target = target(); return target == null ? null : answer(invoke(target)); }
 *     protected Promise<String> invoke(Object implementation) { return ((Greeter) implementation).greet(a0); }
 * }
 * final class Greeter$$Proxy implements Greeter, ActorProxy {
 *     Recipient troupe$cell;
 *     public Promise<String> greet(String a0) {
 *         var request = new Greeter$$greet$0(troupe$cell, a0);
 *         troupe$cell.send(request);
 *         return request;
 *     }
 * }
 * }
 *
 * <p>The proxy of a suspend function, which Kotlin compiles to {@code Object greet(String name, Continuation caller)},
 * ends with {@code return SuspendingCalls.await(request, caller)}; its message implements
 * {@code SuspendingRequest.call(Object, Object)}.
 */
final class ProxyGenerator {
    static final String CELL = "troupe$cell";
    private static final String RECIPIENT = Type.getInternalName(Recipient.class);
    private static final String CALLBACK_DESCRIPTOR = Type.getDescriptor(Callback.class);
    private static final String RECIPIENT_DESCRIPTOR = Type.getDescriptor(Recipient.class);
    private static final String CALLS = Type.getInternalName(SuspendingCalls.class);
    private static final String AWAIT =
            "(" + Type.getDescriptor(Promise.class) + "Ljava/lang/Object;)Ljava/lang/Object;";

    /** What a method is to its caller, and the class that its messages extend. */
    enum Kind {
        ONE_WAY(Message.class),
        REQUEST(Request.class),
        SUSPENDING(SuspendingRequest.class);

        final String parent;
        final String sent; // the parameter of Recipient.send

        Kind(Class<?> parent) {
            this.parent = Type.getInternalName(parent);
            this.sent = Type.getDescriptor(parent == Message.class ? Message.class : Request.class);
        }

        static Kind of(Method method) {
            if (SuspendingCalls.isSuspending(method)) {
                return SUSPENDING;
            }
            return method.getReturnType() == void.class ? ONE_WAY : REQUEST;
        }

        /** The arguments that a message carries: all but the continuation of the caller. */
        Type[] arguments(Method method) {
            Type[] all = Type.getArgumentTypes(method);
            return this == SUSPENDING ? Arrays.copyOf(all, all.length - 1) : all;
        }
    }

    private final Class<?> type;
    private final String typeName;
    private final List<Method> messages;
    private final LocalMethods locals;
    private final MethodHandles.Lookup lookup;

    ProxyGenerator(Class<?> type, ActorMethods methods, MethodHandles.Lookup lookup) {
        this.type = type;
        this.typeName = Type.getInternalName(type);
        this.messages = methods.messages();
        this.locals = new LocalMethods(type, typeName + "$$Proxy", CELL, RECIPIENT, methods);
        this.lookup = lookup;
    }

    Class<?> generate() {
        for (int index = 0; index < messages.size(); index++) {
            define(lookup, type, new MessageGenerator(type, messages.get(index), messageName(index)).generate());
        }
        return define(lookup, type, proxy());
    }

    static Class<?> define(MethodHandles.Lookup lookup, Class<?> type, byte[] bytes) {
        try {
            return lookup.defineClass(bytes);
        } catch (IllegalAccessException | LinkageError e) {
            throw new ActorTypeException("the proxy of " + type.getName() + " cannot be defined in its package", e);
        }
    }

    /** The number distinguishes overloads, and every message class from the proxy class. */
    private String messageName(int index) {
        return typeName + "$$" + messages.get(index).getName() + "$" + index;
    }

    private byte[] proxy() {
        boolean isInterface = type.isInterface();
        String superName = isInterface ? "java/lang/Object" : typeName;
        String proxyMarker = Type.getInternalName(ActorProxy.class);
        var writer = new ClassWriter(ClassWriter.COMPUTE_MAXS);
        writer.visit(
                V21,
                ACC_FINAL | ACC_SUPER | ACC_SYNTHETIC,
                typeName + "$$Proxy",
                null,
                superName,
                isInterface ? new String[] {typeName, proxyMarker} : new String[] {proxyMarker});
        target(writer, typeName + "$$Proxy", isInterface, CELL, RECIPIENT_DESCRIPTOR);
        cellAccessor(writer);
        for (int index = 0; index < messages.size(); index++) {
            send(writer, messages.get(index), messageName(index));
        }
        locals.write(writer);
        writer.visitEnd();
        return writer.toByteArray();
    }

    /** The field to which a proxy delegates, and for an interface its constructor: see {@link ActorType}. */
    static void target(ClassWriter writer, String proxyName, boolean isInterface, String field, String descriptor) {
        writer.visitField(isInterface ? ACC_FINAL : 0, field, descriptor, null, null)
                .visitEnd();
        if (!isInterface) {
            return;
        }
        MethodVisitor code = writer.visitMethod(0, "<init>", "(" + descriptor + ")V", null, null);
        code.visitCode();
        code.visitVarInsn(ALOAD, 0);
        code.visitMethodInsn(INVOKESPECIAL, "java/lang/Object", "<init>", "()V", false);
        code.visitVarInsn(ALOAD, 0);
        code.visitVarInsn(ALOAD, 1);
        code.visitFieldInsn(PUTFIELD, proxyName, field, descriptor);
        code.visitInsn(RETURN);
        finish(code);
    }

    private void cellAccessor(ClassWriter writer) {
        MethodVisitor code = writer.visitMethod(ACC_PUBLIC, CELL, "()" + RECIPIENT_DESCRIPTOR, null, null);
        code.visitCode();
        loadCell(code);
        code.visitInsn(ARETURN);
        finish(code);
    }

    /** Generates {@code new Message(cell, arguments)}, the send, and for a request its return. */
    private void send(ClassWriter writer, Method method, String messageName) {
        Kind kind = Kind.of(method);
        MethodVisitor code =
                writer.visitMethod(ACC_PUBLIC, method.getName(), Type.getMethodDescriptor(method), null, null);
        code.visitCode();
        loadCell(code);
        code.visitTypeInsn(NEW, messageName);
        code.visitInsn(DUP);
        loadCell(code);
        int local = 1;
        var descriptor = new StringBuilder("(").append(RECIPIENT_DESCRIPTOR);
        for (Type argument : kind.arguments(method)) {
            if (argument.getDescriptor().equals(CALLBACK_DESCRIPTOR)) {
                loadCell(code);
                code.visitVarInsn(ALOAD, local);
                code.visitMethodInsn(
                        INVOKEVIRTUAL, RECIPIENT, "returning", "(Ljava/lang/Object;)Ljava/lang/Object;", false);
                code.visitTypeInsn(CHECKCAST, argument.getInternalName());
            } else {
                code.visitVarInsn(argument.getOpcode(ILOAD), local);
            }
            local += argument.getSize();
            descriptor.append(argument.getDescriptor());
        }
        code.visitMethodInsn(
                INVOKESPECIAL, messageName, "<init>", descriptor.append(")V").toString(), false);
        if (kind != Kind.ONE_WAY) {
            code.visitInsn(DUP_X1); // the stack is now: message, cell, message
        }
        code.visitMethodInsn(INVOKEVIRTUAL, RECIPIENT, "send", "(" + kind.sent + ")V", false);
        if (kind == Kind.SUSPENDING) {
            code.visitVarInsn(ALOAD, local); // the caller's continuation
            code.visitMethodInsn(INVOKESTATIC, CALLS, "await", AWAIT, false);
        }
        code.visitInsn(kind == Kind.ONE_WAY ? RETURN : ARETURN);
        finish(code);
    }

    private void loadCell(MethodVisitor code) {
        code.visitVarInsn(ALOAD, 0);
        code.visitFieldInsn(GETFIELD, typeName + "$$Proxy", CELL, RECIPIENT_DESCRIPTOR);
    }

    static void finish(MethodVisitor code) {
        code.visitMaxs(0, 0);
        code.visitEnd();
    }

    static void box(MethodVisitor code, Type primitive) {
        String wrapper = switch (primitive.getSort()) {
            case Type.BOOLEAN -> "Boolean";
            case Type.CHAR -> "Character";
            case Type.BYTE -> "Byte";
            case Type.SHORT -> "Short";
            case Type.INT -> "Integer";
            case Type.LONG -> "Long";
            case Type.FLOAT -> "Float";
            case Type.DOUBLE -> "Double";
            default -> null;
        };
        if (wrapper != null) {
            code.visitMethodInsn(
                    INVOKESTATIC,
                    "java/lang/" + wrapper,
                    "valueOf",
                    "(" + primitive.getDescriptor() + ")Ljava/lang/" + wrapper + ";",
                    false);
        }
    }

    /** Generates the message class of one method: its arguments in typed fields, and the call. */
    private static final class MessageGenerator {
        private final Class<?> type;
        private final Method method;
        private final String name;
        private final Kind kind;
        private final Type[] arguments;
        private final boolean oneWay;
        private final String result;

        MessageGenerator(Class<?> type, Method method, String name) {
            this.type = type;
            this.method = method;
            this.name = name;
            this.kind = Kind.of(method);
            this.arguments = kind.arguments(method);
            this.oneWay = kind == Kind.ONE_WAY;
            this.result = oneWay ? "V" : Type.getDescriptor(Promise.class);
        }

        byte[] generate() {
            var writer = new ClassWriter(ClassWriter.COMPUTE_MAXS);
            String parent = kind.parent;
            writer.visit(V21, ACC_FINAL | ACC_SUPER | ACC_SYNTHETIC, name, null, parent, null);
            for (int index = 0; index < arguments.length; index++) {
                writer.visitField(ACC_FINAL, "a" + index, arguments[index].getDescriptor(), null, null)
                        .visitEnd();
            }
            constructor(writer, parent);
            serve(writer, parent);
            invoke(writer);
            methodName(writer);
            argumentArray(writer);
            writer.visitEnd();
            return writer.toByteArray();
        }

        private void constructor(ClassWriter writer, String parent) {
            var descriptor = new StringBuilder("(").append(RECIPIENT_DESCRIPTOR);
            for (Type argument : arguments) {
                descriptor.append(argument.getDescriptor());
            }
            MethodVisitor code =
                    writer.visitMethod(0, "<init>", descriptor.append(")V").toString(), null, null);
            code.visitCode();
            code.visitVarInsn(ALOAD, 0);
            code.visitVarInsn(ALOAD, 1);
            code.visitMethodInsn(INVOKESPECIAL, parent, "<init>", "(" + RECIPIENT_DESCRIPTOR + ")V", false);
            int local = 2;
            for (int index = 0; index < arguments.length; index++) {
                code.visitVarInsn(ALOAD, 0);
                code.visitVarInsn(arguments[index].getOpcode(ILOAD), local);
                code.visitFieldInsn(PUTFIELD, name, "a" + index, arguments[index].getDescriptor());
                local += arguments[index].getSize();
            }
            code.visitInsn(RETURN);
            finish(code);
        }

        /** Overrides the parent's method with the same code, so that the call site of {@code invoke} is monomorphic. */
        private void serve(ClassWriter writer, String parent) {
            String node = Type.getDescriptor(QueueEntry.class);
            MethodVisitor code =
                    writer.visitMethod(ACC_PROTECTED, "serve", "()" + node, null, new String[] {"java/lang/Throwable"});
            var nobody = new Label();
            code.visitCode();
            code.visitVarInsn(ALOAD, 0);
            code.visitMethodInsn(INVOKEVIRTUAL, parent, "target", "()Ljava/lang/Object;", false);
            code.visitVarInsn(ASTORE, 1);
            code.visitVarInsn(ALOAD, 1);
            code.visitJumpInsn(IFNULL, nobody);
            code.visitVarInsn(ALOAD, 0);
            if (!oneWay) {
                code.visitInsn(DUP);
            }
            code.visitVarInsn(ALOAD, 1);
            code.visitMethodInsn(INVOKEVIRTUAL, name, "invoke", "(Ljava/lang/Object;)" + result, false);
            if (oneWay) {
                code.visitInsn(ACONST_NULL);
            } else {
                code.visitMethodInsn(INVOKEVIRTUAL, parent, "answer", "(" + result + ")" + node, false);
            }
            code.visitInsn(ARETURN);
            code.visitLabel(nobody);
            code.visitFrame(F_APPEND, 1, new Object[] {"java/lang/Object"}, 0, null);
            code.visitInsn(ACONST_NULL);
            code.visitInsn(ARETURN);
            finish(code);
        }

        /** Generates the call of the method: {@code invoke}, or for a suspend function {@code call}. */
        private void invoke(ClassWriter writer) {
            boolean suspending = kind == Kind.SUSPENDING;
            MethodVisitor code = writer.visitMethod(
                    suspending ? ACC_PUBLIC : ACC_PROTECTED,
                    suspending ? "call" : "invoke",
                    suspending
                            ? "(Ljava/lang/Object;Ljava/lang/Object;)Ljava/lang/Object;"
                            : "(Ljava/lang/Object;)" + result,
                    null,
                    new String[] {"java/lang/Throwable"});
            code.visitCode();
            code.visitVarInsn(ALOAD, 1);
            code.visitTypeInsn(CHECKCAST, Type.getInternalName(type));
            for (int index = 0; index < arguments.length; index++) {
                loadArgument(code, index);
            }
            if (suspending) {
                code.visitVarInsn(ALOAD, 2);
                code.visitTypeInsn(CHECKCAST, Type.getArgumentTypes(method)[arguments.length].getInternalName());
            }
            boolean isInterface = type.isInterface();
            code.visitMethodInsn(
                    isInterface ? INVOKEINTERFACE : INVOKEVIRTUAL,
                    Type.getInternalName(type),
                    method.getName(),
                    Type.getMethodDescriptor(method),
                    isInterface);
            code.visitInsn(oneWay ? RETURN : ARETURN);
            finish(code);
        }

        private void methodName(ClassWriter writer) {
            MethodVisitor code = writer.visitMethod(ACC_PUBLIC, "method", "()Ljava/lang/String;", null, null);
            code.visitCode();
            code.visitLdcInsn(type.getSimpleName() + "." + SuspendingCalls.signature(method));
            code.visitInsn(ARETURN);
            finish(code);
        }

        private void argumentArray(ClassWriter writer) {
            MethodVisitor code = writer.visitMethod(ACC_PUBLIC, "arguments", "()[Ljava/lang/Object;", null, null);
            code.visitCode();
            code.visitIntInsn(SIPUSH, arguments.length);
            code.visitTypeInsn(ANEWARRAY, "java/lang/Object");
            for (int index = 0; index < arguments.length; index++) {
                code.visitInsn(DUP);
                code.visitIntInsn(SIPUSH, index);
                loadArgument(code, index);
                box(code, arguments[index]);
                code.visitInsn(AASTORE);
            }
            code.visitInsn(ARETURN);
            finish(code);
        }

        private void loadArgument(MethodVisitor code, int index) {
            code.visitVarInsn(ALOAD, 0);
            code.visitFieldInsn(GETFIELD, name, "a" + index, arguments[index].getDescriptor());
        }
    }

    /**
     * Generates the methods of a proxy that send no message: bridges, methods that throw, {@code toString},
     * {@code equals} and {@code hashCode}.
     */
    static final class LocalMethods {
        private final Class<?> type;
        private final String proxyName;
        private final String field;
        private final String fieldType;
        private final ActorMethods methods;

        /**
         * Creates a generator.
         *
         * @param field the field whose text is the proxy's
         */
        LocalMethods(Class<?> type, String proxyName, String field, String fieldType, ActorMethods methods) {
            this.type = type;
            this.proxyName = proxyName;
            this.field = field;
            this.fieldType = fieldType;
            this.methods = methods;
        }

        void write(ClassWriter writer) {
            methods.bridges().forEach(bridge -> bridge(writer, bridge.from(), bridge.to()));
            for (Method method : methods.refused()) {
                refuse(
                        writer,
                        method.getModifiers() & (ACC_PUBLIC | ACC_PROTECTED),
                        method.getName(),
                        Type.getMethodDescriptor(method),
                        ActorMethods.show(method)
                                + " was called on a proxy, and is no message because it is not public: make it public, or call it inside the actor");
            }
            nameAsText(writer);
            if (!type.isInterface()) {
                lifecycle(writer, "started");
                lifecycle(writer, "stopped");
                identity(writer);
            }
        }

        private void bridge(ClassWriter writer, Method from, Method to) {
            MethodVisitor code = writer.visitMethod(
                    ACC_PUBLIC | ACC_BRIDGE | ACC_SYNTHETIC,
                    from.getName(),
                    Type.getMethodDescriptor(from),
                    null,
                    null);
            code.visitCode();
            code.visitVarInsn(ALOAD, 0);
            Type[] given = Type.getArgumentTypes(from);
            Type[] wanted = Type.getArgumentTypes(to);
            int local = 1;
            for (int index = 0; index < given.length; index++) {
                code.visitVarInsn(given[index].getOpcode(ILOAD), local);
                if (!wanted[index].equals(given[index])) {
                    code.visitTypeInsn(CHECKCAST, wanted[index].getInternalName());
                }
                local += given[index].getSize();
            }
            code.visitMethodInsn(INVOKEVIRTUAL, proxyName, to.getName(), Type.getMethodDescriptor(to), false);
            code.visitInsn(Type.getReturnType(from).getOpcode(IRETURN));
            finish(code);
        }

        private void lifecycle(ClassWriter writer, String name) {
            String text = type.getSimpleName() + "." + name
                    + "() was called on a proxy, and is no message: the actor's space calls it";
            refuse(writer, ACC_PUBLIC, name, "()V", text);
        }

        private static void refuse(ClassWriter writer, int access, String name, String descriptor, String text) {
            MethodVisitor code = writer.visitMethod(access, name, descriptor, null, null);
            code.visitCode();
            code.visitTypeInsn(NEW, "java/lang/IllegalStateException");
            code.visitInsn(DUP);
            code.visitLdcInsn(text);
            code.visitMethodInsn(
                    INVOKESPECIAL, "java/lang/IllegalStateException", "<init>", "(Ljava/lang/String;)V", false);
            code.visitInsn(ATHROW);
            finish(code);
        }

        private void nameAsText(ClassWriter writer) {
            MethodVisitor code = writer.visitMethod(ACC_PUBLIC, "toString", "()Ljava/lang/String;", null, null);
            code.visitCode();
            code.visitVarInsn(ALOAD, 0);
            code.visitFieldInsn(GETFIELD, proxyName, field, "L" + fieldType + ";");
            code.visitMethodInsn(INVOKEVIRTUAL, fieldType, "toString", "()Ljava/lang/String;", false);
            code.visitInsn(ARETURN);
            finish(code);
        }

        /** A class actor's own equals and hashCode would read fields that are unset in a proxy. */
        private static void identity(ClassWriter writer) {
            MethodVisitor hash = writer.visitMethod(ACC_PUBLIC, "hashCode", "()I", null, null);
            hash.visitCode();
            hash.visitVarInsn(ALOAD, 0);
            hash.visitMethodInsn(INVOKESTATIC, "java/lang/System", "identityHashCode", "(Ljava/lang/Object;)I", false);
            hash.visitInsn(IRETURN);
            finish(hash);
            MethodVisitor equals = writer.visitMethod(ACC_PUBLIC, "equals", "(Ljava/lang/Object;)Z", null, null);
            equals.visitCode();
            equals.visitVarInsn(ALOAD, 0);
            equals.visitVarInsn(ALOAD, 1);
            equals.visitMethodInsn(
                    INVOKESTATIC,
                    Type.getInternalName(Recipient.class),
                    "same",
                    "(Ljava/lang/Object;Ljava/lang/Object;)Z",
                    false);
            equals.visitInsn(IRETURN);
            finish(equals);
        }
    }
}
