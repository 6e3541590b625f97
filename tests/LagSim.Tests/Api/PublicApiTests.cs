using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Runtime.CompilerServices;
using LagSim.Net.Sessions;
using Xunit;

namespace LagSim.Tests.Api;

/// <summary>The public surface of what users reference, as text. It changes on purpose or not at all.</summary>
public sealed class PublicApiTests
{
    private const string Update = "LAGSIM_UPDATE_API";
    private const BindingFlags Declared = BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.Instance | BindingFlags.Static | BindingFlags.DeclaredOnly;

    private static readonly NullabilityInfoContext Nullability = new();

    [Fact]
    public void PublicApi_OfWhatUsersReference_IsTheOneOnRecord() => IsTheOneOnRecord("PublicApi.txt", Listing());

    [Fact]
    public void PublicApi_OfTestsForGames_IsTheOneOnRecord() => IsTheOneOnRecord("PublicApi.Testing.txt", Listing(typeof(LagSim.Testing.SessionTest).Assembly));

#if WITH_LITENETLIB
    [Fact]
    public void PublicApi_OfTheLiteNetLibCarrier_IsTheOneOnRecord() =>
        IsTheOneOnRecord("PublicApi.LiteNetLib.txt", Listing(typeof(LagSim.Net.Carriers.LiteNetLibPort).Assembly));
#endif

    [Fact]
    public void Listing_OfKnownMembers_HasThemAndNothingInternal()
    {
        string[] now = Listing().ToArray();
        Assert.Contains("LagSim.Simulation: SubmitResult Submit(in ExternalEvent external)", now);
        Assert.Contains("LagSim.Net.Sessions.Session: string? EndReason { get; }", now);
        Assert.Contains("LagSim.SubmitResult.TooOld = 3", now);
        Assert.DoesNotContain(now, line => line.Contains("TimelineStore", StringComparison.Ordinal) || line.Contains("CutsByTime", StringComparison.Ordinal));
    }

    private static void IsTheOneOnRecord(string file, IEnumerable<string> listing)
    {
        string path = Path.Combine(RepositoryRoot.Path, "tests", "LagSim.Tests", "Api", file);
        string[] now = listing.ToArray();
        if (Environment.GetEnvironmentVariable(Update) == "1")
        {
            File.WriteAllText(path, string.Join("\n", now) + "\n");
        }

        string[] onRecord = File.Exists(path) ? File.ReadAllLines(path) : [];
        string[] changes = [.. onRecord.Except(now).Select(line => "- " + line), .. now.Except(onRecord).Select(line => "+ " + line)];
        Assert.True(
            onRecord.SequenceEqual(now),
            $"The public API is not the one in {path}:\n{string.Join("\n", changes)}\n"
            + $"If that is meant, run the tests once with {Update}=1 in the environment, look at the diff, and say it in the CHANGELOG.");
    }

    private static IEnumerable<string> Listing() => Listing(typeof(Simulation).Assembly, typeof(Session).Assembly);

    private static IEnumerable<string> Listing(params Assembly[] assemblies) => assemblies
        .SelectMany(assembly => assembly.GetExportedTypes())
        .SelectMany(type => Members(type).Prepend(Header(type)))
        .Distinct().Order(StringComparer.Ordinal);

    private static string Header(Type type)
    {
        string kind = type.IsEnum ? $"enum : {Name(Enum.GetUnderlyingType(type))}"
            : type.IsInterface ? "interface"
            : typeof(Delegate).IsAssignableFrom(type) ? "delegate"
            : type.IsValueType ? (type.IsDefined(typeof(IsReadOnlyAttribute)) ? "readonly struct" : "struct")
            : type is { IsAbstract: true, IsSealed: true } ? "static class"
            : type.IsAbstract ? "abstract class"
            : type.IsSealed ? "sealed class"
            : "class";
        Type[] bases = type.IsEnum ? [] : type.GetInterfaces().Where(i => i.IsVisible).OrderBy(Name, StringComparer.Ordinal).ToArray();
        IEnumerable<string> all = bases.Select(Name);
        if (type.BaseType is { } parent && parent != typeof(object) && parent != typeof(ValueType) && parent != typeof(Enum))
        {
            all = all.Prepend(Name(parent));
        }

        return $"{type.FullName} ({kind})" + (all.Any() ? $" : {string.Join(", ", all)}" : "");
    }

    private static IEnumerable<string> Members(Type type)
    {
        string of = type.FullName!;
        if (type.IsEnum)
        {
            return Enum.GetNames(type).Select(name => $"{of}.{name} = {Convert.ToInt64(Enum.Parse(type, name), CultureInfo.InvariantCulture)}");
        }

        return type.GetMembers(Declared).Select(member => Text(member)).OfType<string>().Select(text => $"{of}: {text}");
    }

    private static string? Text(MemberInfo member) => member switch
    {
        ConstructorInfo c when IsSeen(c) => $"{Modifiers(c)}new({Parameters(c)})",
        MethodInfo m when IsSeen(m) && (!m.IsSpecialName || m.Name.StartsWith("op_", StringComparison.Ordinal)) =>
            $"{Modifiers(m)}{Type(Nullability.Create(m.ReturnParameter), m.ReturnType)} {m.Name}{Generic(m)}({Parameters(m)})",
        PropertyInfo p when p.GetAccessors(true).Any(IsSeen) => Property(p),
        FieldInfo f when f.IsPublic || f.IsFamily => $"{(f.IsLiteral ? "const " : f.IsStatic ? "static " : "")}{(f.IsInitOnly ? "readonly " : "")}"
            + $"{Type(Nullability.Create(f), f.FieldType)} {f.Name}{(f.IsLiteral ? $" = {Convert.ToString(f.GetRawConstantValue(), CultureInfo.InvariantCulture)}" : "")}",
        EventInfo e when IsSeen(e.AddMethod!) => $"event {Type(Nullability.Create(e), e.EventHandlerType!)} {e.Name}",
        _ => null,
    };

    private static string Property(PropertyInfo property)
    {
        MethodInfo any = property.GetAccessors(true).First(IsSeen);
        string index = property.GetIndexParameters().Length > 0 ? $"[{string.Join(", ", property.GetIndexParameters().Select(Parameter))}]" : "";
        string get = property.GetMethod is { } getter && IsSeen(getter) ? "get; " : "";
        bool isInit = property.SetMethod?.ReturnParameter.GetRequiredCustomModifiers().Contains(typeof(IsExternalInit)) == true;
        string set = property.SetMethod is { } setter && IsSeen(setter) ? (isInit ? "init; " : "set; ") : "";
        return $"{Modifiers(any)}{Type(Nullability.Create(property), property.PropertyType)} {property.Name}{index} {{ {get}{set}}}";
    }

    private static bool IsSeen(MethodBase method) => method.IsPublic || method.IsFamily || method.IsFamilyOrAssembly;

    private static string Modifiers(MethodBase method) =>
        (method.IsPublic ? "" : "protected ")
        + (method.IsStatic ? "static " : "")
        + (method.DeclaringType!.IsInterface ? "" : method.IsAbstract ? "abstract " : method is { IsVirtual: true, IsFinal: false } ? "virtual " : "");

    private static string Generic(MethodInfo method) =>
        method.IsGenericMethod ? $"<{string.Join(", ", method.GetGenericArguments().Select(argument => argument.Name))}>" : "";

    private static string Parameters(MethodBase method) => string.Join(", ", method.GetParameters().Select(Parameter));

    private static string Parameter(ParameterInfo parameter)
    {
        Type type = parameter.ParameterType.IsByRef ? parameter.ParameterType.GetElementType()! : parameter.ParameterType;
        string how = parameter.IsOut ? "out " : parameter.IsIn ? "in " : parameter.ParameterType.IsByRef ? "ref " : "";
        string standard = !parameter.HasDefaultValue ? "" : $" = {(parameter.RawDefaultValue is null ? "default" : Convert.ToString(parameter.RawDefaultValue, CultureInfo.InvariantCulture))}";
        return $"{how}{Type(Nullability.Create(parameter), type)} {parameter.Name}{standard}";
    }

    private static string Type(NullabilityInfo nullability, Type type) =>
        Name(type) + (!type.IsValueType && nullability.ReadState == NullabilityState.Nullable ? "?" : "");

    private static string Name(Type type)
    {
        if (Nullable.GetUnderlyingType(type) is { } inner)
        {
            return Name(inner) + "?";
        }

        if (type.IsArray)
        {
            return Name(type.GetElementType()!) + "[]";
        }

        if (type.IsByRef)
        {
            return "ref " + Name(type.GetElementType()!);
        }

        if (type.IsGenericType)
        {
            return $"{type.Name.Split('`')[0]}<{string.Join(", ", type.GetGenericArguments().Select(Name))}>";
        }

        return type.Namespace != "System" || type.IsEnum ? type.Name : type.Name switch
        {
            "Void" => "void",
            "Boolean" => "bool",
            "Byte" => "byte",
            "UInt16" => "ushort",
            "Int32" => "int",
            "UInt32" => "uint",
            "Int64" => "long",
            "UInt64" => "ulong",
            "Double" => "double",
            "String" => "string",
            "Object" => "object",
            _ => type.Name,
        };
    }
}
