using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Numerics;
using System.Reflection;
using LagSim.Rules;
using LagSim.Tests.Api;
using Xunit;

namespace LagSim.Tests.Rules;

/// <summary>The list of what rules may not use, shipped in the package: each line names something, and no function of Math is forgotten.
/// That the compiler then refuses it is tried by .ci/rules, with the packages.</summary>
public sealed class BannedSymbolTests
{
    /// <summary>Exact by IEEE 754 or whole numbers, or no computation at all: the same bits everywhere.</summary>
    private static readonly string[] Exact =
    [
        "Abs", "BigMul", "BitDecrement", "BitIncrement", "Ceiling", "Clamp", "CopySign", "DivRem", "Floor", "IEEERemainder", "ILogB", "Max",
        "MaxMagnitude", "Min", "MinMagnitude", "Round", "ScaleB", "Sign", "Sqrt", "Truncate",
        "ConvertToInteger", "CreateChecked", "CreateSaturating", "CreateTruncating", "DegreesToRadians", "Ieee754Remainder", "IsEvenInteger",
        "IsFinite", "IsInfinity", "IsInteger", "IsNaN", "IsNegative", "IsNegativeInfinity", "IsNormal", "IsOddInteger", "IsPositive",
        "IsPositiveInfinity", "IsPow2", "IsRealNumber", "IsSubnormal", "MaxMagnitudeNumber", "MaxNumber", "MinMagnitudeNumber", "MinNumber",
        "Parse", "RadiansToDegrees", "TryParse",
    ];

    private static readonly string[] Lines =
        [.. File.ReadLines(Path.Combine(RepositoryRoot.Path, "src", "LagSim", "buildTransitive", "BannedSymbols.Rules.txt")).Where(line => line[0] != '#')];

    private static readonly string[] Banned = [.. Lines.Select(line => line.Split(';')[0])];

    [Fact]
    public void List_EveryLine_NamesASymbolThatThereIsAndSaysWhy()
    {
        Assert.Equal(["P:System.DateTime.Then", "T:System.Hashset"], Unknown(["P:System.DateTime.Then", "T:System.Hashset", "P:System.DateTime.Today"])); // the control
        Assert.Empty(Unknown(Banned));
        Assert.All(Lines, line => Assert.Equal(2, line.Split(';', 2).Count(part => part.Length > 10)));
        Assert.Equal(Banned.Length, Banned.Distinct().Count());
    }

    [Theory]
    [InlineData(typeof(Math))]
    [InlineData(typeof(double))]
    public void List_EveryFunctionOfDoubles_IsExactOrBanned(Type type)
    {
        string[] forgotten = [.. Functions(type).Where(one => !Exact.Contains(one.Name)).Select(Identity).Where(one => !Banned.Contains(one))];
        Assert.True(forgotten.Length == 0, string.Join('\n', forgotten));
        // Parse is exact; one of its forms is banned, since it reads the text by the language of the machine.
        Assert.DoesNotContain(Functions(type), one => Exact.Contains(one.Name) && one.Name != "Parse" && Banned.Contains(Identity(one)));
        Assert.Contains(Functions(type), one => one.Name == "Sin" && Banned.Contains(Identity(one))); // the control
    }

    /// <summary>What stays allowed is held to whole numbers of any size, so to the definition rather than to itself.</summary>
    [Fact]
    public void Allowed_OnAnyDouble_IsWhatItsDefinitionSays()
    {
        Random random = new(7);
        for (int n = 0; n < 20_000; n++)
        {
            double a = Draw(random), b = Draw(random);
            Assert.Equal(FloorOf(a), new BigInteger(Math.Floor(a)));
            Assert.Equal(-FloorOf(-a), new BigInteger(Math.Ceiling(a)));
            Assert.Equal(a < 0 ? -FloorOf(-a) : FloorOf(a), new BigInteger(Math.Truncate(a)));
            Assert.Equal(NearestOf(a), new BigInteger(Math.Round(a)));
            BigInteger whole = Scaled(b);
            Assert.Equal(BigInteger.Remainder(Scaled(a), whole), Scaled(a % b));
            Assert.InRange(BigInteger.Abs(Scaled(Math.IEEERemainder(a, b)) * 2), 0, BigInteger.Abs(whole));
            Assert.Equal(0, (Scaled(a) - Scaled(Math.IEEERemainder(a, b))) % whole);
        }
    }

    private static readonly int Scale = 200;

    /// <summary>A double with an exponent from -60 to 59, so that 2^200 times it is whole.</summary>
    private static double Draw(Random random) =>
        Math.ScaleB(random.NextInt64(1L << 52, 1L << 53) >> random.Next(50), random.Next(-112, 8)) * (random.Next(2) == 0 ? 1 : -1);

    private static BigInteger Scaled(double value)
    {
        long bits = BitConverter.DoubleToInt64Bits(value);
        int exponent = (int)((bits >> 52) & 0x7FF);
        BigInteger mantissa = (bits & ((1L << 52) - 1)) | (exponent == 0 ? 0 : 1L << 52);
        int shift = Math.Max(exponent, 1) - 1075 + Scale;
        Assert.True(shift >= 0 || value == 0);
        return (bits < 0 ? -1 : 1) * (value == 0 ? 0 : mantissa << shift);
    }

    private static BigInteger FloorOf(double value) => Scaled(value) >> Scale;

    private static BigInteger NearestOf(double value)
    {
        BigInteger floor = FloorOf(value), half = Scaled(value) - (floor << Scale) - (BigInteger.One << (Scale - 1));
        return half > 0 || (half == 0 && !floor.IsEven) ? floor + 1 : floor;
    }

    private static IEnumerable<MethodInfo> Functions(Type type) => type
        .GetMethods(BindingFlags.Public | BindingFlags.Static | BindingFlags.DeclaredOnly)
        .Where(method => !method.IsSpecialName && (type == typeof(double) || method.GetParameters().Any(one => one.ParameterType == typeof(double))));

    private static string[] Unknown(string[] identities)
    {
        Assembly[] assemblies =
        [
            .. ((string)AppContext.GetData("TRUSTED_PLATFORM_ASSEMBLIES")!).Split(Path.PathSeparator)
                .Where(file => Path.GetFileName(file).StartsWith("System.", StringComparison.Ordinal)).Select(file => Assembly.Load(AssemblyName.GetAssemblyName(file))),
            typeof(GameRules).Assembly,
        ];
        return [.. identities.Where(identity => !IsThere(identity, assemblies))];
    }

    private static bool IsThere(string identity, Assembly[] assemblies)
    {
        string name = identity[2..].Split('(')[0];
        string owner = identity[0] == 'T' ? name : name[..name.LastIndexOf('.')];
        Type? type = assemblies.Select(one => one.GetType(owner)).FirstOrDefault(one => one is not null);
        const BindingFlags all = BindingFlags.Public | BindingFlags.Instance | BindingFlags.Static | BindingFlags.DeclaredOnly;
        return type is not null && identity[0] switch
        {
            'T' => true,
            'P' => type.GetProperty(name[(owner.Length + 1)..], all) is not null,
            'M' => type.GetMethods(all).Any(method => Identity(method) == identity),
            _ => false,
        };
    }

    /// <summary>A method as documentation files and the analyzer write it.</summary>
    private static string Identity(MethodInfo method)
    {
        string generic = method.IsGenericMethod ? $"``{method.GetGenericArguments().Length}" : "";
        string[] parameters = [.. method.GetParameters().Select(one => NameOf(one.ParameterType))];
        return $"M:{method.DeclaringType!.FullName}.{method.Name}{generic}" + (parameters.Length == 0 ? "" : $"({string.Join(',', parameters)})");
    }

    private static string NameOf(Type type) => type switch
    {
        { IsByRef: true } => NameOf(type.GetElementType()!) + "@",
        { IsArray: true } => NameOf(type.GetElementType()!) + "[]",
        { IsGenericMethodParameter: true } => $"``{type.GenericParameterPosition}",
        { IsGenericType: true } => $"{type.Namespace}.{type.Name.Split('`')[0]}{{{string.Join(',', type.GetGenericArguments().Select(NameOf))}}}",
        _ => type.FullName!,
    };
}
