#include "capture/mat_reader.hpp"

#include "capture/csv_reader.hpp"
#include "capture/mat_check.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "common/text.hpp"

#include <cmath>
#include <matio.h>
#include <memory>

namespace servoid {

namespace {

using File = std::unique_ptr<mat_t, decltype(&Mat_Close)>;
using Variable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

// matio prints to stderr by default; our message says it already.
void silent_log(int, char*) {}

class MatReader {
  public:
    MatReader(const std::string& path, const SignalMap* map)
        : path_(path), map_(map), file_(nullptr, &Mat_Close) {}

    RawTable read() {
        const std::string bytes = read_file(path_);
        check_mat_file(path_, bytes);
        file_size_ = bytes.size();
        Mat_LogInitFunc("servoid", silent_log);
        file_.reset(Mat_Open(path_.c_str(), MAT_ACC_RDONLY));
        if (!file_) fail("cannot be read as a MATLAB level 5 file");
        list_variables();
        if (!map_)
            fail("a .mat file needs a map of its variables (--map FILE); it has " + join(names_));
        return read_table();
    }

  private:
    [[noreturn]] void fail(const std::string& reason) const { throw FileError(path_, 0, reason); }
    [[noreturn]] void fail_variable(const std::string& name, const std::string& reason) const {
        fail("variable " + in_quotes(name) + " " + reason);
    }

    void list_variables() {
        while (Variable info{Mat_VarReadNextInfo(file_.get()), &Mat_VarFree})
            if (info->name) names_.emplace_back(info->name);
        if (names_.empty()) fail("holds no variables, or is cut off");
    }

    RawTable read_table() const {
        RawTable table;
        table.path = path_;
        table.metadata_path = map_->path;
        for (const auto& [key, value] : map_->metadata)
            table.metadata[key] = {value, 0};
        table.columns = mapped_columns(*map_, names_, path_);
        check_columns(table);
        for (RawColumn& column : table.columns)
            read_variable(column);
        check_lengths(table);
        return table;
    }

    // A compressed variable may claim any size; deflate cannot shrink more than this.
    void check_claimed_size(const std::string& name) const {
        constexpr double best_compression = 1032;
        const Variable info{Mat_VarReadInfo(file_.get(), name.c_str()), &Mat_VarFree};
        if (!info) fail_variable(name, "cannot be read; the file looks cut off or damaged");
        double count = 1;
        for (int d = 0; d < info->rank; ++d)
            count *= static_cast<double>(info->dims[d]);
        if (count > best_compression * static_cast<double>(file_size_))
            fail_variable(name, "claims more numbers than the file can hold; it is damaged");
    }

    void read_variable(RawColumn& column) const {
        check_claimed_size(column.name);
        const Variable variable{Mat_VarRead(file_.get(), column.name.c_str()), &Mat_VarFree};
        if (!variable || (!variable->data && variable->nbytes > 0))
            fail_variable(column.name, "cannot be read; the file looks cut off or damaged");
        check_shape(*variable, column.name);
        copy_values(*variable, column);
        for (size_t i = 0; i < column.values.size(); ++i)
            if (!std::isfinite(column.values[i]))
                fail("variable " + in_quotes(column.name) + ": row " + std::to_string(i + 1) +
                     " is not a finite number");
    }

    void check_shape(const matvar_t& variable, const std::string& name) const {
        switch (variable.class_type) {
        case MAT_C_STRUCT:
            fail_variable(name, "is a struct; expected a vector of numbers");
        case MAT_C_CELL:
            fail_variable(name, "is a cell array; expected a vector of numbers");
        case MAT_C_CHAR:
            fail_variable(name, "is text; expected a vector of numbers");
        case MAT_C_SPARSE:
            fail_variable(name, "is sparse; expected a vector of numbers");
        default:
            break;
        }
        if (variable.isComplex) fail_variable(name, "is complex; expected real numbers");
        size_t longer = 0;
        for (int d = 0; d < variable.rank; ++d)
            longer += variable.dims[d] != 1;
        if (longer > 1) {
            std::string size = std::to_string(variable.dims[0]);
            for (int d = 1; d < variable.rank; ++d)
                size += "x" + std::to_string(variable.dims[d]);
            fail_variable(name, "is a " + size + " matrix; expected a vector");
        }
    }

    template <class T> static void copy_as(const matvar_t& variable, std::vector<double>& values) {
        const T* data = static_cast<const T*>(variable.data);
        const size_t count = variable.nbytes / sizeof(T);
        values.reserve(count);
        for (size_t i = 0; i < count; ++i)
            values.push_back(static_cast<double>(data[i]));
    }

    void copy_values(const matvar_t& variable, RawColumn& column) const {
        column.printing = printed_as_integer;
        switch (variable.class_type) {
        case MAT_C_DOUBLE:
            column.printing = printed_as_double;
            return copy_as<double>(variable, column.values);
        case MAT_C_SINGLE:
            column.printing = printed_as_float;
            return copy_as<float>(variable, column.values);
        case MAT_C_INT8:
            return copy_as<mat_int8_t>(variable, column.values);
        case MAT_C_UINT8:
            return copy_as<mat_uint8_t>(variable, column.values);
        case MAT_C_INT16:
            return copy_as<mat_int16_t>(variable, column.values);
        case MAT_C_UINT16:
            return copy_as<mat_uint16_t>(variable, column.values);
        case MAT_C_INT32:
            return copy_as<mat_int32_t>(variable, column.values);
        case MAT_C_UINT32:
            return copy_as<mat_uint32_t>(variable, column.values);
        case MAT_C_INT64:
            return copy_as<mat_int64_t>(variable, column.values);
        case MAT_C_UINT64:
            return copy_as<mat_uint64_t>(variable, column.values);
        default:
            fail_variable(column.name, "is of a class that holds no numbers");
        }
    }

    void check_lengths(const RawTable& table) const {
        constexpr size_t fewest = 16;
        for (const RawColumn& column : table.columns)
            if (column.values.size() != table.rows())
                fail_variable(column.name, "has " + std::to_string(column.values.size()) +
                                               " values, " + in_quotes(table.columns.front().name) +
                                               " has " + std::to_string(table.rows()) +
                                               "; expected equal lengths");
        if (table.rows() < fewest)
            fail("only " + std::to_string(table.rows()) + " rows; expected at least " +
                 std::to_string(fewest));
    }

    const std::string& path_;
    const SignalMap* map_;
    File file_;
    size_t file_size_ = 0;
    std::vector<std::string> names_;
};

} // namespace

RawTable read_mat(const std::string& path, const SignalMap* map) {
    return MatReader(path, map).read();
}

} // namespace servoid
